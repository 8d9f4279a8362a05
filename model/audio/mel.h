#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "model/audio/fourier.h"

namespace choreo {

inline constexpr int kFftSize = 2048;  ///< samples at 22 050 Hz: the length of an analysis window
inline constexpr int kMelBands =
    128;  ///< Slaney's bands between 0 and 11 025 Hz, each of unit area

/// One value of 10 log10(power), with powers below 1e-10 taken as 1e-10 (-100 dB).
double PowerToDb(double power);

/// The power in each mel band of one window of samples: periodic Hann window, squared magnitude of
/// the Fourier transform, triangular bands. Holds work space: one a thread.
class MelSpectrum {
 public:
  MelSpectrum();

  /// `samples`: kFftSize of them, or more, which are not looked at. The result is valid until the
  /// next call.
  std::span<const double, kMelBands> Power(std::span<const float> samples);

 private:
  struct Tables;
  const Tables& tables_;
  RealFourier fourier_;
  std::vector<double> windowed_;
  std::array<double, kMelBands> power_{};
};

/// [frame, mel band] in dB.
using MelSpectrogram = Eigen::Matrix<double, Eigen::Dynamic, kMelBands, Eigen::RowMajor>;

/// The mel spectrogram in dB of mono samples at 22 050 Hz; frame f is centred at sample f * hop,
/// and there are 1 + samples / hop. Audio before and after is silence. Throws
/// Error(kInvalidArgument) for no samples or hop < 1.
MelSpectrogram MelSpectrogramDb(std::span<const float> mono, int hop);

}  // namespace choreo
