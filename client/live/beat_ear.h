#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <span>
#include <vector>

#include "model/audio/beats/beat_hint.h"
#include "model/audio/beats/beats_ahead.h"
#include "model/audio/beats/onset.h"

namespace choreo::live {

/// A person's hint about the beats of live music.
struct LiveBeatHint {
  BeatHint beats = {};
  std::optional<double> downbeat_s = {};  ///< second of the music at which a bar began
  double later_s = 0;                     ///< seconds by which beats come later than the found ones

  bool operator==(const LiveBeatHint&) const = default;
};

/// Predicts the beats of live music: finds the beats of its last minutes as in a whole song
/// (TrackBeats), and extrapolates. Works on its own thread, so that Hear never waits.
class BeatEar {
 public:
  /// How far ahead of the music beats are predicted, seconds: the length of a transition.
  static constexpr double kAheadSeconds = 5;

  explicit BeatEar(const LiveBeatHint& hint = {});

  /// Replaces the hint, and searches for beats again.
  void SetHint(const LiveBeatHint& hint);
  const LiveBeatHint& hint() const { return hint_; }

  /// Takes the next mono samples at 22 050 Hz. Returns beats ahead about every other second, and
  /// none while no beat is clear.
  BeatsAhead Hear(std::span<const float> mono);
  /// Waits for a search in progress, whose beats the next Hear returns. Needed by callers that do
  /// not run in real time.
  void Wait() const {
    if (found_.valid()) found_.wait();
  }

 private:
  OnsetMeter meter_;
  std::vector<float> mono_;    // from the next onset's window on
  std::vector<Onset> onsets_;  // of the last minutes
  int64_t first_ = 0;          // index of the first of onsets_ in the music
  int64_t searched_ = 0;       // onsets received at the last search
  std::future<BeatTrack> found_;
  LiveBeatHint hint_;
  std::optional<int64_t> kept_;  // a beat of the last search, so that half time keeps its beats
  std::optional<int64_t> one_;   // the last downbeat, counted from the hint's downbeat
};

}  // namespace choreo::live
