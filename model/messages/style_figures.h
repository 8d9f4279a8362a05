#pragma once

namespace choreo {

/// How often a classifier, trained on the recordings, recognises the requested style in dances:
/// percent of seconds, measured and by chance.
struct StyleFigures {
  double recognised = 0, chance = 0;
  double low = 0;  ///< lower end of the 95 % interval of `recognised`

  /// Whether people can see it: recognised at least a quarter more often than by chance, with 95 %
  /// confidence.
  bool shows() const { return low > 1.25 * chance; }
};

}  // namespace choreo
