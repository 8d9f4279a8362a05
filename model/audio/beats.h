#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "model/audio/onset.h"

namespace choreo {

/// Frames (of the model) by which a dancer's beat may miss the music's and still hit it.
inline constexpr double kBeatGap = 2;

/// How far ahead, in seconds, music can still move a beat.
inline constexpr int kTempoWindowSeconds = 8;

/// The beats that a dancer would count.
struct BeatTrack {
  double tempo_bpm = 0;           ///< of most beats; 0 without beats
  int beats_in_bar = 0;           ///< in most bars: 4, 3, or 2 of three eighths each
  std::vector<int64_t> frames{};  ///< ascending, in steps of kOnsetHop samples at 22 050 Hz
  std::vector<int> in_bar{};      ///< of each beat; 0: a downbeat
  /// Of each beat: how much more begins on the beats around it than elsewhere, 0 to 1. It is not
  /// the chance that they are right: sound begins on half of the beats, or twice as many, too.
  std::vector<double> confidence{};

  std::vector<double> Seconds() const;
  std::vector<double> DownbeatSeconds() const;
};

/// The range of tempi searched.
struct TempoLimits {
  double slowest_bpm = 48, fastest_bpm = 208;
};

/// Whether onsets cover a whole song or its last seconds only. Music has played before the latter,
/// and few of its beats tell whether their halves are alike.
enum class MusicExtent { kWhole, kPart };

/// Finds a song's beats with the bar pointer model (BarPointer): the tempo, beats and bars that
/// best explain all onsets. Tempo may drift or jump. Silence has no beats, except one a period
/// after the last sound; after two seconds of silence tracking starts afresh. Beats and half beats
/// no more distinct than those found in noise are dropped. Without onsets: no
/// beats, tempo 0. `mono`: the samples of the onsets, whose harmony corrects where bars begin
/// (CountByHarmony); without them drums alone tell.
BeatTrack TrackBeats(std::span<const Onset> onsets, const TempoLimits& limits = {},
                     MusicExtent extent = MusicExtent::kWhole, std::span<const float> mono = {});

/// Whether these onsets end in silence, more than `period_s` after the last sound.
bool EndInPause(std::span<const Onset> onsets, double period_s);

/// The beats of mono samples at 22 050 Hz. Throws what FindOnsets throws.
BeatTrack FindBeats(std::span<const float> mono);

/// The tempo of most beats: the mean of the intervals near their median. 0 for fewer than two
/// beats. `seconds` ascend.
double TempoOf(std::span<const double> seconds);

/// Where no beat is heard for more than four seconds, [from, to), in music of `seconds`. Beats, in
/// seconds, ascend.
std::vector<std::pair<double, double>> WithoutBeats(std::span<const double> beats, double seconds);

}  // namespace choreo
