#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/beats/bar_pointer.h"
#include "model/audio/beats/meter.h"
#include "model/audio/beats/onset.h"

/// Decides by the music's repetition whether beats are half beats, and which metre it has. Patterns
/// show these badly, because any part of a beat may be struck in any pattern.
namespace choreo {

/// Whether each beat lies where all bands' onsets are strong: drums have all, few others do.
std::vector<bool> AreStrong(std::span<const Onset> onsets, std::span<const BarPointer::Step> path);

/// The onsets at each half of each beat of a path: EvenOnsets' bands, the strongest nearby. Beats
/// in parts with weak onsets relative to the strongest part, as without drums, do not count.
/// Immutable.
class HalfBeats {
 public:
  HalfBeats(std::span<const Onset> onsets, std::span<const BarPointer::Step> path);

  /// The median period of the beats that count, frames; 0 without any.
  int Period() const;

  /// Whether both halves of beats sound the same in all bands, so that each is a beat: the mean of
  /// the weaker one is at least `share` of the stronger one's.
  bool AreAlike(double share) const;

  /// AreAlike in 4/4, except that a bass drum may sound on one of the four halves of two beats.
  /// Each half is then a beat, and that one begins the bar.
  bool AreAlikeButForAccent(double share) const;

  /// Whether the beats are off-beats: the bass drum sounds halfway between nearly all of them, and
  /// hardly on them.
  bool BassIsBetween() const;

  /// The half of nearly all beats, 0 or 1, on which a snare sounds while a bass drum sounds on the
  /// other, so that each half is a beat; -1: neither. A hi-hat between the beats has too weak
  /// middle bands, and beats that are not halves have too little bass between them.
  int SnareHalf() const;

  /// The metre, found by comparing bars: music in 4/4 repeats after eight eighths, in 3/4 and 6/8
  /// after six, and 6/8 is more similar after three eighths than after two.
  Meter MeterOf() const;

 private:
  using Bands = std::array<double, Onset::kBands>;
  static constexpr size_t kPlaces = 4;  // halves of two beats, a bar if each is a beat

  double Correlation(size_t lag) const;

  std::vector<Bands> halves_;
  std::vector<std::array<bool, Onset::kBands>> is_heard_;
  std::vector<bool> counts_;   // by half
  std::vector<size_t> place_;  // by half: which half of an odd or even beat
  std::vector<int> periods_;   // of the beats that count
};

/// The path with each beat half a beat earlier, and one more after the last, within `frames`. Bars
/// keep their position: patterns expect a backbeat's snare just after a bar's first beat.
std::vector<BarPointer::Step> HalfABeatEarly(const std::vector<BarPointer::Step>& path,
                                             int64_t frames);

/// The path with a beat added halfway to each next one that is at least `slow` frames away, in bars
/// of four that begin with a first (`half` 0) or a second half (1).
std::vector<BarPointer::Step> Doubled(const std::vector<BarPointer::Step>& path, int slow,
                                      int half = 0);

}  // namespace choreo
