#include "model/formats/containers/pickled_text.h"

#include <boost/locale/encoding_utf.hpp>
#include <charconv>
#include <cstdint>

namespace choreo {
namespace {

// Removes and parses this many hexadecimal digits at the beginning.
std::optional<uint32_t> TakeHex(std::string_view* text, size_t digits) {
  uint32_t value = 0;
  const std::string_view taken = text->substr(0, digits);
  const auto [end, error] = std::from_chars(taken.data(), taken.data() + taken.size(), value, 16);
  if (error != std::errc() || end != taken.data() + digits) return std::nullopt;
  text->remove_prefix(digits);
  return value;
}

}  // namespace

std::optional<std::string> ReadPickledString(std::string_view line) {
  if (line.size() < 2 || line.front() != line.back() || (line[0] != '\'' && line[0] != '"'))
    return std::nullopt;
  line = line.substr(1, line.size() - 2);
  std::string text;
  while (!line.empty()) {
    const char first = line[0];
    line.remove_prefix(1);
    if (first != '\\') {
      text += first;
      continue;
    }
    if (line.empty()) return std::nullopt;
    const char escaped = line[0];
    line.remove_prefix(1);
    switch (escaped) {
      case 'n':
        text += '\n';
        break;
      case 'r':
        text += '\r';
        break;
      case 't':
        text += '\t';
        break;
      case '\\':
      case '\'':
      case '"':
        text += escaped;
        break;
      case 'x': {
        const std::optional<uint32_t> code = TakeHex(&line, 2);
        if (!code) return std::nullopt;
        text += static_cast<char>(*code);
        break;
      }
      default:
        return std::nullopt;
    }
  }
  return text;
}

std::optional<std::string> ReadPickledUnicode(std::string_view line) {
  std::u32string text;
  while (!line.empty()) {
    const bool escaped = line[0] == '\\' && line.size() > 1 && (line[1] == 'u' || line[1] == 'U');
    if (!escaped) {
      text += static_cast<unsigned char>(line[0]);
      line.remove_prefix(1);
      continue;
    }
    const size_t digits = line[1] == 'u' ? 4 : 8;
    line.remove_prefix(2);
    const std::optional<uint32_t> code = TakeHex(&line, digits);
    if (!code) return std::nullopt;
    text += *code;
  }
  return boost::locale::conv::utf_to_utf<char>(text);
}

}  // namespace choreo
