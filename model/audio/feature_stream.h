#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "model/audio/mel.h"
#include "model/audio/mfcc.h"
#include "model/audio/resample.h"
#include "model/audio/row_onset.h"
#include "model/audio/row_sound.h"

namespace choreo {

/// Music as the models hear it, while it arrives: push samples of any format, read MFCC rows at 30
/// a second. Row r is centred at second r / 30 of the absolute audio clock; it is that of Mfcc().
/// Audio before 0 and after the end is silence. A row's bits depend on the samples near it alone,
/// neither on how they are chunked nor on where the stream starts. Not thread-safe.
class FeatureStream {
 public:
  /// `first_sample`: absolute index, at `sample_rate`, of the first sample that will be pushed, for
  /// a stream that goes on where another one ended. Errors as Resampler.
  FeatureStream(double sample_rate, int channels, int64_t first_sample = 0);

  /// Whole interleaved frames, all finite, before Finish: the caller has checked that.
  void Push(std::span<const float> interleaved);
  /// The audio ends here: every row becomes final. May be called again.
  void Finish();

  /// Row r can be read if first_row() <= r < final_rows(). After Finish that is every row: those
  /// beyond the audio are silence's, and this is the largest int64_t. Use audio_rows() to size a
  /// buffer.
  int64_t final_rows() const;
  /// 0, or, where the stream starts later, the first row whose whole window lies in the stream; or
  /// the first that is not forgotten.
  int64_t first_row() const { return first_row_; }
  /// Rows from 0 on whose centre lies within the audio so far: 1 + samples / 735 at 22 050 Hz, as
  /// librosa counts; 0 before any.
  int64_t audio_rows() const;
  /// kMfccCount values, valid until they are forgotten. Throws Error(kOutOfRange) for a row that is
  /// not final or before first_row().
  std::span<const float> Row(int64_t row) const;
  /// Of a row, which must be final and not forgotten; beyond the audio no onset and no power. In a
  /// stream that starts later, the onsets of the first RowOnset::kMemory rows are not what the
  /// whole music has.
  const RowSound& Sound(int64_t row) const;
  /// Rows before `row` are needed no more: first_row() moves up to it, or to the first row that is
  /// not final.
  void Forget(int64_t row);

  /// Absolute index of the sample that Push expects next.
  int64_t next_sample() const { return first_sample_ + pushed_; }
  bool finished() const { return finished_; }
  /// How far, in samples at 22 050 Hz, audio must reach beyond a row's centre for it to be final at
  /// this input rate.
  int latency_samples() const;

  /// The latest `first_sample` for which a stream's first_row() is at most `row`: from where to
  /// send a song again to resume it.
  static int64_t FirstSampleFor(int64_t row, double sample_rate);

 private:
  struct RowValues {
    std::array<float, kMfccCount> mfcc{};
    RowSound sound;
  };

  const RowValues& ValuesOf(int64_t row) const;
  void ComputeRows();
  static RowValues RowOf(std::span<const float> samples, RowOnset* onset);  // the first kFftSize

  double sample_rate_;
  int channels_;
  int64_t first_sample_;
  Resampler resampler_;
  int64_t pushed_ = 0;
  bool finished_ = false;
  std::vector<float> mono_;  // at 22 050 Hz; what future rows still need
  int64_t mono_start_ = 0;   // absolute index of mono_[0]
  int64_t first_row_ = 0;
  std::deque<RowValues> rows_;  // a deque, so that rows stay where they are
  RowOnset onset_;
  RowValues silence_{};
};

}  // namespace choreo
