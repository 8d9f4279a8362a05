#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "model/dance/audio_feed.h"
#include "model/messages/dance_event.h"

namespace choreo {

/// Which beat to report with which frame of a dance. Not thread-safe.
class BeatReport {
 public:
  /// `audio`: the dance's, or null. `last`: for a resumed dance, last() at its first frame.
  BeatReport(double fps, const AudioFeed* audio, std::optional<double> last)
      : fps_(fps), audio_(audio), last_(last) {}

  /// Starts handing out the transition that begins at `from` and has these beats.
  void Start(std::span<const Beat> beats, int64_t from);

  /// The beats to report with a frame of that transition. Call once per frame, in order; its row
  /// must be ready. Every beat is reported once, even if two transitions place it on different
  /// sides of their boundary; a beat that each leaves to the other comes with the first frame after
  /// it. Drops beats that were predicted before the music fell silent, from one period after its
  /// last sound on.
  std::vector<Beat> TakeAt(int64_t frame);

  /// The last beat reported, in seconds: all the state that resuming a dance here needs.
  const std::optional<double>& last() const { return last_; }

  /// All beats reported, seconds, ascending.
  const std::vector<double>& reported() const { return reported_; }

 private:
  // A beat to report, and its distance to the nearer neighbour; 0 without neighbours.
  struct Ahead {
    Beat beat;
    double step;
  };

  double Seconds(int64_t frame) const { return static_cast<double>(frame) / fps_; }

  double fps_;
  const AudioFeed* audio_;
  std::deque<Ahead> ahead_;  // of the transition, not yet reported
  std::optional<double> last_;
  std::vector<double> reported_;
};

}  // namespace choreo
