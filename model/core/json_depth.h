#pragma once

#include <string>
#include <string_view>

namespace choreo {

/// Refuses JSON that is nested deeper than any file of ours or glTF's: what reads, copies or prints
/// it calls itself once a level, and would run out of stack. Throws Error(kInvalidArgument) whose
/// field is `name`, naming the limit. Other faults are the parser's to find.
void CheckJsonDepth(std::string_view json, const std::string& name);

}  // namespace choreo
