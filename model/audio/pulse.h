#pragma once

#include <span>

/// Predicts beats while the music plays, from the past alone. All counts are rows of a
/// FeatureStream, 30 a second.
namespace choreo {

/// The pulse that a listener would tap at the end of the music so far.
struct Pulse {
  double next = 0;        ///< rows from the last one received to the next beat, in (0, period]
  double period = 0;      ///< rows between beats; 0: no pulse was found
  double confidence = 0;  ///< 0 to 1: how well beats predicted a second ahead met onsets

  /// Whether the pulse is safe to dance to. Random onsets stay below.
  bool Certain() const;
};

/// Rows of memory: 12 s.
inline constexpr int kPulseMemory = 360;

/// The predominant pulse, between 60 and 200 beats a minute, of the last kPulseMemory of `onsets`
/// (RowOnset, one per row, oldest first). A bank of damped resonators, one for each tempo with its
/// double and quadruple, finds tempo and phase; a pulse is kept until another has been clearly
/// better for a second. Pure.
Pulse HearPulse(std::span<const float> onsets);

}  // namespace choreo
