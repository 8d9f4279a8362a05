#pragma once

#include <string>
#include <string_view>

namespace choreo {

/// Makes untrusted text safe to print on a terminal: escapes control characters and invalid UTF-8
/// as \x1b and the like.
std::string Printable(std::string_view text);

}  // namespace choreo
