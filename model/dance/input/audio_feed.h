#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "model/audio/music/feature_stream.h"
#include "model/audio/music/music_dynamics.h"
#include "model/core/grid.h"
#include "model/plan/model_info.h"

namespace choreo {

/// Throws Error(kInvalidArgument, "samples") unless the data is whole sample frames of finite
/// numbers. The message counts positions from `first_sample`.
void CheckSamples(std::span<const float> interleaved, int channels, int64_t first_sample);

/// Past rows whose sound is kept: all that a dance looks back on.
inline constexpr int kSoundMemory = kDynamicsMemory + kTypicalFrames;

/// Converts samples to what a dance hears: the sound of each row, and the rows of the model's
/// MusicFeatures. One thread at a time may push; any thread may read. Readers never wait for a
/// transform, because rows are computed outside the lock and published in short turns.
class AudioFeed {
 public:
  /// Throws what FeatureStream throws.
  AudioFeed(double sample_rate, int channels, int64_t first_sample, MusicFeatures features = {});

  /// Adds samples, and calls `on_rows` whenever it has added rows. Throws Error(kOutOfRange) unless
  /// `first_sample` is the next sample, Error(kInvalidArgument) for bad samples and beyond
  /// kMaxAudioSeconds, and Error(kFailedPrecondition) after Finish. If it throws, it has added
  /// nothing.
  void Push(std::span<const float> interleaved, int64_t first_sample,
            const std::function<void()>& on_rows);
  /// Ends the audio. Every row is ready from now on; rows after the audio are silence.
  void Finish();
  bool finished() const { return features_.finished(); }  // pushing side

  int64_t next_sample() const { return features_.next_sample(); }  // pushing side
  /// The number of frames, from time 0, that start before the end of the samples so far:
  /// ceil(samples fps / rate). Call on the pushing side only.
  int64_t EndFrame(double fps) const;
  /// The length of the music so far. Call on the pushing side only.
  double seconds() const { return static_cast<double>(features_.next_sample()) / sample_rate_; }
  /// Whether all music so far, without the DC offset with which it begins, is quieter than
  /// kMinLevel. False if the feed does not begin with the music's first sample. Call on the pushing
  /// side only.
  bool silent() const { return whole_ && peak_ < kMinLevel; }
  /// Whether the channels cancel each other, so that the mix has at most a hundredth of their peak.
  /// Call on the pushing side only.
  bool cancels() const { return whole_ && !silent() && mixed_peak_ <= 0.01F * peak_; }

  /// The first row that cannot be read yet.
  int64_t ready() const;
  /// The model's rows, one per column, for the `count` rows before `frame`, oldest first. All must
  /// be ready. Rows before 0 are silence.
  Eigen::MatrixXf History(int64_t frame, int count) const;
  /// The sound of the last `count` rows before `row`, fewer at the start of the music. `count`: at
  /// most kSoundMemory. All must be ready.
  std::vector<RowSound> Sounds(int64_t row, int count) const;
  /// Frees the rows before `row`, so that memory does not grow with the stream.
  void Forget(int64_t row);

 private:
  void Publish();
  // Requires mutex_.
  const Eigen::VectorXf& Heard(int64_t row) const;

  double sample_rate_;
  int channels_;
  FeatureStream features_;
  const MusicFeatures music_features_;
  Eigen::VectorXf silence_;     // the model's row for silence; empty if the model does not hear
  bool whole_;                  // whether it begins with the music's first sample
  std::vector<float> offsets_;  // of the channels: their first samples
  float peak_ = 0, mixed_peak_ = 0;  // of the channels beside these, and of their mix

  mutable std::mutex mutex_;  // guards the members below
  int64_t first_row_;
  int64_t ready_;
  int64_t published_;                 // the first row not yet published
  std::deque<Eigen::VectorXf> rows_;  // the model's rows, from first_row_ to published_
  int64_t first_sound_;
  std::deque<RowSound> sounds_;  // from first_sound_ on
};

}  // namespace choreo
