#pragma once

#include <google/protobuf/text_format.h>

#include <string>

#include "tests/server/fixture.h"

namespace choreo {

/// Adds what `text` says, in protobuf's text format.
inline void Merge(const std::string& text, google::protobuf::Message* message) {
  EXPECT_TRUE(google::protobuf::TextFormat::MergeFromString(text, message)) << text;
}

}  // namespace choreo
