#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "model/audio/music/row_sound.h"
#include "model/audio/signal/mel.h"
#include "model/audio/signal/resampler.h"

namespace choreo {

/// Converts arriving music to rows of mel bands and sound, 30 per second: push samples of any
/// format, then read rows. Row r is centred at r / 30 seconds of the absolute audio clock, and
/// equals MelSpectrogram()'s row. Audio before 0 and after the end is silence. A row's bits depend
/// only on the samples near it, not on chunk sizes or where the stream starts. Not thread-safe.
class FeatureStream {
 public:
  /// `first_sample`: absolute index, at `sample_rate`, of the first sample to be pushed, for a
  /// stream that continues another. Throws what Resampler throws.
  FeatureStream(double sample_rate, int channels, int64_t first_sample = 0);

  /// Takes whole interleaved frames, all finite (the caller checks), before Finish.
  void Push(std::span<const float> interleaved);
  /// Ends the audio, so that every row becomes final. Further calls do nothing.
  void Finish();

  /// Row r is readable if first_row() <= r < final_rows(). After Finish all rows are readable, with
  /// silence beyond the audio, and this returns the largest int64_t, so size buffers by
  /// audio_rows().
  int64_t final_rows() const;
  /// The first readable row: 0 or, in a stream that starts later, the first whose whole window is
  /// in the stream; after Forget, the first row kept.
  int64_t first_row() const { return first_row_; }
  /// The number of rows from 0 on whose centre lies within the audio so far: 1 + samples / 735 at
  /// 22 050 Hz, as librosa counts; 0 before any audio.
  int64_t audio_rows() const;
  /// The mel bands of a row, valid until forgotten. Throws Error(kOutOfRange) for a row that is not
  /// final or before first_row().
  const MelBandsDb& Bands(int64_t row) const;
  /// The sound of a row that Bands has. Beyond the audio it has neither onset nor power. In a
  /// stream that starts later, the onsets of the first kRowSoundMemory rows differ from the whole
  /// song's.
  const RowSound& Sound(int64_t row) const;
  /// Frees the rows before `row`: first_row() moves to it, or to the first row that is not final.
  void Forget(int64_t row);

  /// Absolute index of the sample that Push expects next.
  int64_t next_sample() const { return first_sample_ + pushed_; }
  bool finished() const { return finished_; }
  /// The number of samples at 22 050 Hz after a row's centre that the row needs at this input rate.
  int latency_samples() const;

  /// The latest `first_sample` of a stream whose first_row() is at most `row`: where to resume
  /// sending a song.
  static int64_t FirstSampleFor(int64_t row, double sample_rate);

 private:
  struct RowValues {
    MelBandsDb bands{};
    RowSound sound;
  };

  const RowValues& ValuesOf(int64_t row) const;
  void ComputeRows();
  /// The state of onset detection.
  struct Beginnings {
    RowOnset rows;
    OnsetMeter frames;
  };
  static RowValues RowOf(std::span<const float> samples,
                         Beginnings* beginnings);  // uses the first kFftSize

  double sample_rate_;
  int channels_;
  int64_t first_sample_;
  Resampler resampler_;
  int64_t pushed_ = 0;
  bool finished_ = false;
  std::vector<float> mono_;  // at 22 050 Hz; only what future rows need
  int64_t mono_start_ = 0;   // absolute index of mono_[0]
  int64_t first_row_ = 0;
  std::deque<RowValues> rows_;  // a deque, so that rows keep their addresses
  Beginnings beginnings_;
  RowValues silence_{};
};

/// The sound of each row of a whole song: mono samples at 22 050 Hz.
std::vector<RowSound> SoundsOf(std::span<const float> mono);

}  // namespace choreo
