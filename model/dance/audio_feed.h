#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "model/audio/feature_stream.h"
#include "model/audio/mfcc.h"
#include "model/audio/music_dynamics.h"
#include "model/audio/pulse.h"
#include "model/core/grid.h"

namespace choreo {

/// Throws Error(kInvalidArgument, "audio.data") unless these are whole sample frames of finite
/// numbers; the message counts from `first_sample`.
void CheckSamples(std::span<const float> interleaved, int channels, int64_t first_sample);

/// Rows whose sound is known at any row: all that a dance listens to of its past.
inline constexpr int kSoundMemory = kDynamicsMemory + kUsualFrames;
static_assert(kSoundMemory >= kPulseMemory);

/// Samples on one side, the model's audio rows on the other. One thread at a time pushes; any
/// thread reads, and never waits for a transform: rows are computed apart and handed over in short
/// turns.
class AudioFeed {
 public:
  /// Errors as FeatureStream.
  AudioFeed(double sample_rate, int channels, int64_t first_sample);

  /// Calls `on_rows` whenever rows were added. Throws Error(kOutOfRange) unless `first_sample` is
  /// the next one, Error(kInvalidArgument) for bad samples and beyond kMaxAudioSeconds,
  /// Error(kFailedPrecondition) after Finish; then nothing was taken.
  void Push(std::span<const float> interleaved, int64_t first_sample,
            const std::function<void()>& on_rows);
  /// Every row is ready from here on: those beyond the audio are silence's.
  void Finish();
  bool finished() const { return features_.finished(); }  // pushing side

  int64_t next_sample() const { return features_.next_sample(); }  // pushing side
  /// Frames that start before the end of the samples so far, counted from time 0: ceil(samples fps
  /// / rate). Pushing side.
  int64_t EndFrame(double fps) const;

  /// Rows below this one can be read.
  int64_t ready() const;
  /// Copies a row, which must be ready. Rows before 0 are silence's.
  void CopyRow(int64_t row, std::span<float> to) const;
  /// The `count` rows before `frame`, oldest first, one a column; all must be ready.
  Eigen::MatrixXf History(int64_t frame, int count) const;
  /// What the last `count` rows before `row` sound like, at most kSoundMemory, or as many as there
  /// are of the music; all must be ready.
  std::vector<RowSound> Sounds(int64_t row, int count) const;
  /// Rows before this one are needed no more: a stream of an hour holds what a second's does.
  void Forget(int64_t row);

 private:
  using RowValues = std::array<float, kMfccCount>;

  void Publish();

  double sample_rate_;
  int channels_;
  FeatureStream features_;
  RowValues silence_;

  mutable std::mutex mutex_;  // of what follows
  int64_t first_row_;
  int64_t ready_;
  std::deque<RowValues> rows_;  // from first_row_ on; those behind its end are silence's
  int64_t first_sound_;
  std::deque<RowSound> sounds_;  // from first_sound_ on; behind its end there is none
};

}  // namespace choreo
