#pragma once

#include <optional>
#include <string_view>

namespace choreo::client {

/// Of the seconds that a model danced in asked styles: how many a classifier, which has seen the
/// recordings, takes for the style that was asked for, and how many it would by chance; percent.
struct StyleFigures {
  double recognised, chance;
  double low;  ///< `recognised` is this much at least, by its 95 % interval

  bool shows() const { return low > chance; }
};

/// What was measured (docs/results.md) of the shipped checkpoint that a model's fingerprint names;
/// none of others. Thread-safe.
std::optional<StyleFigures> FindStyleFigures(std::string_view fingerprint);

}  // namespace choreo::client
