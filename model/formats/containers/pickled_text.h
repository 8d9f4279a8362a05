#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Unescapes strings of the text protocols, 0 and 1. Private to this folder.
namespace choreo {

/// 'a\x00b' between quotes, as Python writes bytes: \n, \r, \t, \\, quotes and two digits after
/// \x. nullopt for anything else.
std::optional<std::string> ReadPickledString(std::string_view line);

/// Latin-1 with \uXXXX and \UXXXXXXXX, as UTF-8. nullopt for anything else.
std::optional<std::string> ReadPickledUnicode(std::string_view line);

}  // namespace choreo
