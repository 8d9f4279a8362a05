#pragma once

#include <string>
#include <string_view>

namespace choreo {

/// Words of others as a terminal may show them: control characters, which could do more to it than
/// be read, stand as \x1b and the like, and what is no UTF-8 does, too.
std::string Printable(std::string_view text);

}  // namespace choreo
