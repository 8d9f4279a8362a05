#include "model/core/rounded.h"

#include <charconv>
#include <cmath>
#include <iterator>

namespace choreo {

std::string Rounded(double value) {
  constexpr int kDecimals = 2;
  constexpr double kTiny = 5e-4;  // metres, millimetres or degrees: too small to matter
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value < 0 ? "-inf" : "inf";
  if (std::abs(value) < kTiny) value = 0;
  const int zeros = value == 0 || std::abs(value) >= 0.1
                        ? 0
                        : -1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  const int decimals = kDecimals + zeros;
  char digits[400];  // 1.8e308 has 309 digits
  const auto end =
      std::to_chars(std::begin(digits), std::end(digits), value, std::chars_format::fixed, decimals)
          .ptr;
  std::string text(digits, end);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string RoundedBeyond(double value, double limit) {
  std::string text = Rounded(value);
  return text == Rounded(limit) ? InFull(value) : text;
}

std::string InFull(double value) {
  char text[32];  // the longest double takes 24 characters
  const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
  return {text, end};
}

}  // namespace choreo
