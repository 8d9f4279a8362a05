#include "model/core/printable.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace choreo {
namespace {

/// Bytes of the UTF-8 character that `text` begins with; 0: it begins with none, or with a control
/// character.
size_t CharacterLength(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<uint8_t>(text[i]); };
  const uint8_t first = byte(0);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || length > text.size()) return 0;
  for (size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool control = first == 0xc2 && byte(1) < 0xa0;
  return control ? 0 : length;
}

}  // namespace

std::string Printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    if (const size_t length = CharacterLength(text)) {
      shown += text.substr(0, length);
      text.remove_prefix(length);
      continue;
    }
    char code[5];
    std::snprintf(code, sizeof code, "\\x%02x", static_cast<uint8_t>(text.front()));
    shown += code;
    text.remove_prefix(1);
  }
  return shown;
}

}  // namespace choreo
