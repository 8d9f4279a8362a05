#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace choreo {

class PolyphaseKernel;

/// Streaming resampler: any sample rate and channel count -> mono at 22 050 Hz. Averages channels
/// and filters with a Kaiser-windowed sinc: flat to 0.01 dB below 0.9 of the lower Nyquist
/// frequency, below -95 dB above it. Output sample n is at input position n * sample_rate / 22 050
/// and depends only on the `half_length()` input samples on either side, not on chunks or where the
/// stream starts. Audio before sample 0 and after the end is silence. Not thread-safe.
class Resampler {
 public:
  /// `first_sample`: absolute index of the first sample to be pushed, within kMaxAudioSeconds.
  /// Throws Error(kInvalidArgument) if it is not, and for formats that CheckAudioFormat refuses.
  Resampler(double sample_rate, int channels, int64_t first_sample = 0);

  /// Takes whole interleaved frames, all finite (the caller checks).
  void Push(std::span<const float> interleaved);
  /// Ends the input. Call once. The last output sample is the last one within the audio.
  void Finish();
  /// Appends all output samples that are ready, in order, to `mono`.
  void Pull(std::vector<float>& mono);

  /// Absolute index, at 22 050 Hz, of the first output sample: 0 or, in a stream that starts later,
  /// the first whose whole support lies in the stream.
  int64_t first_output() const { return first_output_; }
  /// Half length of the filter in input samples: the output at input position p is ready after
  /// sample floor(p) + half_length().
  int64_t half_length() const;
  /// Half length of the filter in samples at 22 050 Hz, rounded up.
  int64_t latency() const;

 private:
  void Produce();

  int channels_;
  std::shared_ptr<const PolyphaseKernel> kernel_;  // null if samples pass through
  int64_t in_per_period_ = 1;                      // input / output rate, in lowest terms
  int64_t out_per_period_ = 1;
  std::vector<double> input_;  // downmixed; only what future outputs need
  int64_t input_start_ = 0;    // absolute index of input_[0]
  int64_t first_output_ = 0;
  int64_t next_output_ = 0;
  std::vector<float> ready_;
};

}  // namespace choreo
