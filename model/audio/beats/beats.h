#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "model/audio/beats/onset.h"

namespace choreo {

/// The largest distance, in the model's frames, at which a dancer's beat hits the music's.
inline constexpr double kBeatGap = 2;

/// Seconds of later music that can still move a beat.
inline constexpr int kTempoWindowSeconds = 8;

/// The beats of a song, as a dancer would count them.
struct BeatTrack {
  double tempo_bpm = 0;           ///< of most beats; 0 without beats
  int beats_in_bar = 0;           ///< in most bars: 4, 3, or 2 of three eighths each
  std::vector<int64_t> frames{};  ///< ascending, in steps of kOnsetHop samples at 22 050 Hz
  std::vector<int> in_bar{};      ///< [beats] each beat's count in its bar; 0: a downbeat
  /// [beats] How much stronger onsets are on the beats around it than elsewhere, 0 to 1. Not the
  /// probability that they are right: half or twice as many beats have it, too.
  std::vector<double> confidence{};

  std::vector<double> Seconds() const;
  std::vector<double> DownbeatSeconds() const;
};

/// The range of tempi searched.
struct TempoLimits {
  double slowest_bpm = 48, fastest_bpm = 208;
};

/// Whether onsets cover a whole song, or only its last seconds: too few beats to compare their
/// halves.
enum class MusicExtent { kWhole, kPart };

/// Finds a song's beats with the bar pointer model (BarPointer): the tempo, beats and bars that
/// best explain all onsets. Tempo may drift or jump. Silence has no beats, except one a period
/// after the last sound. A whole song's last 44 ms have none, because they end before one would be
/// heard. After two seconds of silence, tracking starts anew. Drops beats and half beats no more
/// distinct than noise's. Without onsets there are no beats, and the tempo is 0. `mono`: the
/// samples of the onsets, whose harmony corrects the beginnings of bars (CountByHarmony); without
/// them only drums determine these.
BeatTrack TrackBeats(std::span<const Onset> onsets, const TempoLimits& limits = {},
                     MusicExtent extent = MusicExtent::kWhole, std::span<const float> mono = {});

/// Whether these onsets end in silence, more than `period_s` after the last sound.
bool EndInPause(std::span<const Onset> onsets, double period_s);

/// The beats of mono samples at 22 050 Hz. Throws what FindOnsets throws.
BeatTrack FindBeats(std::span<const float> mono);

/// The tempo of most beats, beats per minute, from the mean of the intervals near their median. 0
/// for fewer than two beats. `seconds` ascend.
double TempoOf(std::span<const double> seconds);

/// The stretches [from, to) without a beat for more than four seconds, in music of length
/// `seconds`. Beats are in seconds, ascending.
std::vector<std::pair<double, double>> WithoutBeats(std::span<const double> beats, double seconds);

}  // namespace choreo
