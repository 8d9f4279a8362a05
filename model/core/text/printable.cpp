#include "model/core/text/printable.h"

#include <boost/locale/utf.hpp>
#include <cstdint>
#include <cstdio>

namespace choreo {

std::string Printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const char* end = text.data();
    const auto point = boost::locale::utf::utf_traits<char>::decode(end, text.data() + text.size());
    const bool control = point < 0x20 || (point >= 0x7f && point < 0xa0);
    if (boost::locale::utf::is_valid_codepoint(point) && !control) {
      shown.append(text.data(), end);
      text.remove_prefix(static_cast<size_t>(end - text.data()));
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
