#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "model/audio/feature_stream.h"
#include "model/audio/music_dynamics.h"
#include "model/core/grid.h"
#include "model/plan/transition_spec.h"

namespace choreo {

/// Throws Error(kInvalidArgument, "audio.data") unless these are whole sample frames of finite
/// numbers. The message gives positions counted from `first_sample`.
void CheckSamples(std::span<const float> interleaved, int channels, int64_t first_sample);

/// Past rows whose sound is kept: as many as a dance looks back.
inline constexpr int kSoundMemory = kDynamicsMemory + kTypicalFrames;

/// Turns samples into what a dance hears: the sound of each row, and the rows of a model's own
/// hearing. One thread at a time pushes; any thread reads.
/// Readers never wait for a transform: rows are computed outside the lock and published in short
/// turns.
class AudioFeed {
 public:
  /// Throws what FeatureStream throws.
  AudioFeed(double sample_rate, int channels, int64_t first_sample, Hearing hearing = {});

  /// Calls `on_rows` whenever it has added rows. Throws Error(kOutOfRange) unless `first_sample` is
  /// the next one, Error(kInvalidArgument) for bad samples and beyond kMaxAudioSeconds,
  /// Error(kFailedPrecondition) after Finish. If it throws, it has taken nothing.
  void Push(std::span<const float> interleaved, int64_t first_sample,
            const std::function<void()>& on_rows);
  /// Makes every row ready; rows beyond the audio are silence.
  void Finish();
  bool finished() const { return features_.finished(); }  // pushing side

  int64_t next_sample() const { return features_.next_sample(); }  // pushing side
  /// The number of frames, from time 0, that start before the end of the samples so far:
  /// ceil(samples fps / rate). Only the pushing side calls it.
  int64_t EndFrame(double fps) const;
  /// The length of the music so far. Only the pushing side calls it.
  double seconds() const { return static_cast<double>(features_.next_sample()) / sample_rate_; }
  /// Whether the whole music so far is quieter than kMinLevel; false for one that begins later than
  /// its first sample. Only the pushing side calls it.
  bool silent() const { return whole_ && peak_ < kMinLevel; }
  /// Whether its channels cancel each other in the mix, of which a hundredth at most is left.
  /// Only the pushing side calls it.
  bool cancels() const { return whole_ && !silent() && mixed_peak_ <= 0.01F * peak_; }

  /// Rows below this one can be read.
  int64_t ready() const;
  /// What the model hears in the `count` rows before `frame`, oldest first, one per column; all
  /// must be ready. Rows before 0 are silence.
  Eigen::MatrixXf History(int64_t frame, int count) const;
  /// The sound of the last `count` rows before `row`, at most kSoundMemory; fewer at the start of
  /// the music. All must be ready.
  std::vector<RowSound> Sounds(int64_t row, int count) const;
  /// Frees the rows before this one, so that an hour's stream takes no more memory than a second's.
  void Forget(int64_t row);

 private:
  void Publish();
  // Requires mutex_.
  const Eigen::VectorXf& Heard(int64_t row) const;

  double sample_rate_;
  int channels_;
  FeatureStream features_;
  const Hearing hearing_;
  Eigen::VectorXf silence_;          // as the model hears it; empty if it hears nothing
  bool whole_;                       // begins with the music's first sample
  float peak_ = 0, mixed_peak_ = 0;  // of its channels, and of their mix

  mutable std::mutex mutex_;  // of what follows
  int64_t first_row_;
  int64_t ready_;
  int64_t published_;                 // rows before it
  std::deque<Eigen::VectorXf> rows_;  // as the model hears them, from first_row_ to published_
  int64_t first_sound_;
  std::deque<RowSound> sounds_;  // from first_sound_ on
};

}  // namespace choreo
