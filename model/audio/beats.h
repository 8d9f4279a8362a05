#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace choreo {

/// Frames of the model between a dancer's beat and the music's that she still hits.
inline constexpr double kBeatGap = 2;

/// Beats are counted at a tempo that is heard in windows of so many seconds.
inline constexpr int kTempoWindowSeconds = 8;

/// Where a dancer would count.
struct BeatTrack {
  double tempo_bpm = 0;         ///< 0 where nothing was heard
  std::vector<int64_t> frames;  ///< ascending, in steps of kOnsetHop samples at 22 050 Hz

  std::vector<double> Seconds() const;
};

/// The beats of an onset envelope, as librosa.beat.beat_track (0.10.2; Ellis 2007): dynamic
/// programming for the frames that are strong and keep the tempo (tightness 100); weak beats at
/// either end are dropped. Needs the whole envelope. None, at tempo 0, without onsets.
BeatTrack TrackBeats(std::span<const float> onset_strength);

/// The beats of mono samples at 22 050 Hz, from their OnsetStrength. Errors as that.
BeatTrack FindBeats(std::span<const float> mono);

}  // namespace choreo
