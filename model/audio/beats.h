#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/audio/onset.h"

namespace choreo {

/// Frames of the model between a dancer's beat and the music's that she still hits.
inline constexpr double kBeatGap = 2;

/// How far, in seconds, what comes later may move a beat.
inline constexpr int kTempoWindowSeconds = 8;

/// Where a dancer would count.
struct BeatTrack {
  double tempo_bpm = 0;              ///< of most of the beats; 0 where there are none
  int beats_in_bar = 0;              ///< of most of the bars: 4, 3, or 2 of three eighths each
  std::vector<int64_t> frames{};     ///< ascending, in steps of kOnsetHop samples at 22 050 Hz
  std::vector<int> in_bar{};         ///< of each beat; 0: a downbeat
  std::vector<double> confidence{};  ///< of each beat: 0, as much begins elsewhere, to 1

  std::vector<double> Seconds() const;
  std::vector<double> DownbeatSeconds() const;
};

/// Tempi that are considered.
struct TempoLimits {
  double slowest_bpm = 48, fastest_bpm = 208;
};

/// The beats of a song by the bar pointer model (BarPointer): tempo, beats and bars that explain
/// all of its onsets best. Tempo may change from beat to beat, or at once. Where nothing sounds
/// there are no beats but one a period behind the last sound; behind two seconds of silence they
/// are found anew. Needs all of the music. None, at tempo 0, without onsets.
BeatTrack TrackBeats(std::span<const Onset> onsets, const TempoLimits& limits = {});

/// The beats of mono samples at 22 050 Hz. Errors as FindOnsets.
BeatTrack FindBeats(std::span<const float> mono);

/// Most beats' tempo: the mean of the intervals that are near their median. 0 for less than two.
/// `seconds` ascend.
double TempoOf(std::span<const double> seconds);

}  // namespace choreo
