#pragma once

#include <cstdint>
#include <future>
#include <span>
#include <vector>

#include "model/audio/beats.h"
#include "model/audio/onset.h"

namespace choreo::live {

/// Beats that are still to sound, seconds, ascending, and those of them that begin a bar.
struct BeatsAhead {
  std::vector<double> beats, downbeats;

  /// Leaves those of [from, to].
  void Keep(double from, double to);
};

/// Hears in music that sounds now where it will beat: the beats of its last minutes, found as in a
/// whole song (TrackBeats), go on as they are. They are found in a thread of their own, so who
/// listens never waits.
class BeatEar {
 public:
  /// What is told reaches so far ahead of the music, seconds: as transitions do.
  static constexpr double kAheadSeconds = 5;

  BeatEar();

  /// The next mono samples, at 22 050 Hz. Beats ahead, every other second or so; none while
  /// nothing beats clearly.
  BeatsAhead Hear(std::span<const float> mono);
  /// Until beats that are looked for are found: the next Hear tells them. For who is not in time.
  void Wait() const {
    if (found_.valid()) found_.wait();
  }

 private:
  BeatsAhead GoOn(const BeatTrack& track, double now) const;

  OnsetMeter meter_;
  std::vector<float> mono_;    // of the next onset's window on
  std::vector<Onset> onsets_;  // the last minutes'
  int64_t first_ = 0;          // of onsets_, in onsets from the music's begin
  int64_t asked_ = 0;          // onsets heard when beats were looked for
  std::future<BeatTrack> found_;
};

}  // namespace choreo::live
