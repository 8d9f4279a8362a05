#pragma once

#include <optional>
#include <span>
#include <vector>

#include "client/live/beat_ear.h"
#include "model/audio/music/passage_ear.h"
#include "model/audio/signal/format.h"
#include "model/audio/signal/resampler.h"

namespace choreo::live {

/// A beat behind all music. With a hint it follows the beats of MusicEar: as given beats keep
/// others from between them, the server adds none of its own, for which it has no hint.
inline constexpr double kBeatBehindMusic_s = kMaxAudioSeconds;

/// Predicts the beats and repeats of live music, in any sample format, ahead of a dance.
class MusicEar {
 public:
  struct Ahead {
    BeatsAhead beats;
    std::optional<Passage> passage;
  };

  /// Throws Error(kInvalidArgument) for formats that CheckAudioFormat refuses.
  MusicEar(int sample_rate, int channels, const LiveBeatHint& hint = {});

  /// Takes the next whole interleaved frames, all finite.
  Ahead Hear(std::span<const float> piece);
  void SetHint(const LiveBeatHint& hint) { beats_.SetHint(hint); }

 private:
  Resampler resampler_;
  std::vector<float> mono_;  // of this piece
  BeatEar beats_;
  PassageEar passages_;
};

}  // namespace choreo::live
