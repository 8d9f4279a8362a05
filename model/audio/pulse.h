#pragma once

#include <span>

/// Beats heard while the music plays: what will come, told from what came. Everything here counts
/// in the rows of a FeatureStream, 30 a second.
namespace choreo {

/// The pulse that a listener would tap, at the end of what was heard.
struct Pulse {
  double next = 0;        ///< rows from the last one heard to the next beat, in (0, period]
  double period = 0;      ///< rows from beat to beat; 0: none was found
  double confidence = 0;  ///< 0 to 1: how well beats told a second ahead met onsets

  /// Whether to move to it. Random onsets stay below.
  bool Certain() const;
};

/// Rows that a pulse is heard in: 12 s.
inline constexpr int kPulseMemory = 360;

/// The predominant pulse of the last kPulseMemory of `onsets` (RowOnset, one a row, oldest first),
/// between 60 and 200 beats a minute: a bank of damped resonators, one for each tempo and its
/// double and fourfold, says tempo and phase; a hypothesis is kept until another one has been
/// clearly better for a second. A pure function.
Pulse HearPulse(std::span<const float> onsets);

}  // namespace choreo
