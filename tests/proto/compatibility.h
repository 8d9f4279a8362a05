#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <vector>

namespace choreo {

/// What breaks a program that was built with the API `released` when it meets `current`: messages,
/// fields, enums, values, services and methods that are gone or renamed, and those that changed
/// number, type, label, presence, oneof or streaming; reserved numbers and names that are used
/// again. Additions break nothing. One line each, beginning with the full name; empty where all is
/// well. Pure.
std::vector<std::string> BreakingChanges(const google::protobuf::FileDescriptor& released,
                                         const google::protobuf::DescriptorPool& current);

}  // namespace choreo
