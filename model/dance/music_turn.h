#pragma once

#include <cstdint>
#include <optional>

#include "model/audio/music_dynamics.h"
#include "model/dance/audio_feed.h"
#include "model/dance/timeline.h"

namespace choreo {

/// Finds where the music changes inside a transition that was planned with the music before it. A
/// pure function of the segment and of the music before the frame found: chunk sizes, timing and
/// resumes have no effect. Not thread-safe.
class MusicTurn {
 public:
  /// `listens`: false finds nothing.
  explicit MusicTurn(bool listens, const MusicDynamicsOptions& options = {})
      : listens_(listens), options_(options) {}

  /// Watches this transition from now on. Rows before it must be ready; less than a second of music
  /// before it tells nothing.
  void Watch(const AudioFeed& audio, const Segment& segment);

  /// The frame before `stop` from which on the transition should be danced anew, as far as rows
  /// below `ready` tell.
  std::optional<int64_t> Find(const AudioFeed& audio, int64_t ready, int64_t stop);

 private:
  bool listens_;
  MusicDynamicsOptions options_;
  MusicLevel level_;          // before the transition
  int64_t next_ = 0;          // the next frame to look at
  int64_t last_ = next_ - 1;  // the last one
};

}  // namespace choreo
