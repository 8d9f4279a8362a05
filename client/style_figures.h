#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace choreo::client {

/// Percent of seconds danced in requested styles in which a classifier, trained on the recordings,
/// recognises the requested style, and by chance.
struct StyleFigures {
  double recognised, chance;
  double low;  ///< lower end of the 95 % interval of `recognised`

  /// Whether people can see it: a quarter more often than by chance, and not by chance.
  bool shows() const { return low > chance && recognised > 1.25 * chance; }
};

/// The measurements (docs/results.md) of the shipped checkpoint in a model's fingerprint, or none.
/// Thread-safe.
std::optional<StyleFigures> FindStyleFigures(std::string_view fingerprint);

/// For people, whether the styles of that model can be seen in its dances: "They do not show: in 7
/// % of seconds a classifier recognises the style asked for, by chance in 6 %."
std::string DescribeStyles(std::string_view fingerprint);

}  // namespace choreo::client
