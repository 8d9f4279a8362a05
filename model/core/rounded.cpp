#include "model/core/rounded.h"

#include <cmath>
#include <cstdio>

namespace choreo {

std::string Rounded(double value) {
  constexpr int kDecimals = 2;
  constexpr double kTiny = 1e-6;  // no quantity of a dance
  if (std::abs(value) < kTiny) value = 0;
  const int zeros = value == 0 || std::abs(value) >= 0.1
                        ? 0
                        : -1 - static_cast<int>(std::floor(std::log10(std::abs(value))));
  const int decimals = kDecimals + zeros;
  const int size = std::snprintf(nullptr, 0, "%.*f", decimals, value);
  std::string text(static_cast<size_t>(size) + 1, '\0');
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  text.pop_back();
  if (!std::isfinite(value)) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

}  // namespace choreo
