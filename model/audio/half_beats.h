#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/audio/bar_pointer.h"
#include "model/audio/meter.h"
#include "model/audio/onset.h"

/// What patterns tell badly, as any part of a beat may be struck in any of them, but what the music
/// says by what it repeats.
namespace choreo {

/// What begins with each half of each beat of a path: EvenOnsets' bands, the strongest near it.
class HalfBeats {
 public:
  HalfBeats(std::span<const Onset> onsets, std::span<const BarPointer::Step> path);

  /// Whether both halves of beats sound the same in all bands: then each is a beat itself.
  bool AreAlike() const;

  /// Bars are alike: music in 4/4 returns after eight eighths, in 3/4 and 6/8 after six, and in 6/8
  /// it is more alike after three than after two.
  Meter MeterOf() const;

 private:
  double Correlation(size_t lag) const;

  std::vector<std::array<double, Onset::kBands>> halves_;
};

/// The same path with a beat half way to each next one, in bars of four.
std::vector<BarPointer::Step> Doubled(const std::vector<BarPointer::Step>& path);

}  // namespace choreo
