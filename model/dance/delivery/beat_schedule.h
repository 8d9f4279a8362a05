#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "model/dance/input/audio_feed.h"
#include "model/messages/dance_event.h"

namespace choreo {

/// Assigns each beat of a dance to the frame with which it is reported. Not thread-safe.
class BeatSchedule {
 public:
  /// `audio`: the dance's audio, or null. `last`: for a resumed dance, the value of last() at its
  /// first frame.
  BeatSchedule(double fps, const AudioFeed* audio, std::optional<double> last)
      : fps_(fps), audio_(audio), last_(last) {}

  /// Starts the transition that begins at `from` and has these beats.
  void StartTransition(std::span<const Beat> beats, int64_t from);

  /// The beats to report with a frame of the current transition. Call once per frame, in order; the
  /// frame's row must be ready. Each beat is reported once, even if two transitions place it on
  /// both sides of their boundary. A beat that both leave to the other is reported with the first
  /// frame after it. Drops predicted beats once the music has been silent for one period.
  std::vector<Beat> TakeAt(int64_t frame);

  /// The last reported beat, in seconds: all the state needed to resume a dance here.
  const std::optional<double>& last() const { return last_; }

  /// All reported beats, in seconds, ascending.
  const std::vector<double>& reported() const { return reported_; }

 private:
  // A beat to report, and its distance to the nearer neighbour, or 0 without neighbours.
  struct Ahead {
    Beat beat;
    double step;
  };

  double Seconds(int64_t frame) const { return static_cast<double>(frame) / fps_; }

  double fps_;
  const AudioFeed* audio_;
  std::deque<Ahead> ahead_;  // the current transition's beats, not yet reported
  std::optional<double> last_;
  std::vector<double> reported_;
};

}  // namespace choreo
