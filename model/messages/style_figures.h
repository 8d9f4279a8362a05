#pragma once

namespace choreo {

/// Percent of seconds danced in requested styles in which a classifier, trained on the recordings,
/// recognises the requested style, and by chance.
struct StyleFigures {
  double recognised = 0, chance = 0;
  double low = 0;  ///< lower end of the 95 % interval of `recognised`

  /// Whether people can see it: surely a quarter more often than by chance.
  bool shows() const { return low > 1.25 * chance; }
};

}  // namespace choreo
