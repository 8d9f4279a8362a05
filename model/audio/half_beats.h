#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/bar_pointer.h"
#include "model/audio/meter.h"
#include "model/audio/onset.h"

/// Decides whether beats are half beats, and the metre. Patterns show these badly, because any part
/// of a beat may be struck in any pattern; so the music's repetition decides.
namespace choreo {

/// The onsets at each half of each beat of a path: EvenOnsets' bands, the strongest nearby.
class HalfBeats {
 public:
  HalfBeats(std::span<const Onset> onsets, std::span<const BarPointer::Step> path);

  /// Whether both halves of beats sound the same in all bands, so that each is a beat: the weaker
  /// one's mean is at least this share of the stronger one's.
  bool AreAlike(double share) const;

  /// Whether the bass drum sounds halfway between nearly all beats and hardly on them, so that
  /// those are off-beats.
  bool BassIsBetween() const;

  /// Compares bars: music in 4/4 repeats after eight eighths, in 3/4 and 6/8 after six, and 6/8 is
  /// more alike after three eighths than after two.
  Meter MeterOf() const;

 private:
  double Correlation(size_t lag) const;

  std::vector<std::array<double, Onset::kBands>> halves_;
};

/// The same path, each beat half a beat earlier, and one more after the last, among `frames`. Bars
/// keep their place: patterns expect a backbeat's snare just after their first beat.
std::vector<BarPointer::Step> HalfABeatEarly(const std::vector<BarPointer::Step>& path,
                                             int64_t frames);

/// The same path with a beat added halfway to each next one, in bars of four.
std::vector<BarPointer::Step> Doubled(const std::vector<BarPointer::Step>& path);

}  // namespace choreo
