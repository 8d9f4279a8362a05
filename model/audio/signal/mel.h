#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "model/audio/signal/format.h"
#include "model/audio/signal/fourier.h"
#include "model/core/grid.h"

namespace choreo {

/// Samples between rows; one row per frame of motion.
inline constexpr int kFeatureHop = kModelSampleRate / static_cast<int>(kModelFps);
inline constexpr int kFftSize = 2048;  ///< samples at 22 050 Hz in an analysis window
/// Slaney's bands between 0 and 11 025 Hz, each of unit area.
inline constexpr int kMelBands = 128;
inline constexpr size_t kBassBands = 4;  ///< the first bands, up to 130 Hz, where the bass drum is

/// Each mel band's 10 log10(power), floored at 1e-10 (-100 dB).
using MelBandsDb = std::array<double, kMelBands>;

/// The triangle of one band.
struct MelBand {
  double low_hz = 0, centre_hz = 0, high_hz = 0;
};
MelBand MelBandAt(size_t band);

/// Computes the mel spectrum of one window of samples: periodic Hann window, squared magnitude of
/// the Fourier transform, triangular bands. Not thread-safe: it holds work space.
class MelSpectrum {
 public:
  /// `samples`: at least kFftSize; ignores further ones.
  MelBandsDb Decibels(std::span<const float> samples);
  /// The bands `db` of the same samples, last given, but without their DC offset: the mean, nearest
  /// to 0, of the eighths of the window. Music without an offset hardly ever has one.
  MelBandsDb WithoutDc(std::span<const float> samples, MelBandsDb db) const;

 private:
  FourierPower fourier_{kFftSize};
  std::span<const double> powers_;  // of the samples last given
  std::vector<double> windowed_ = std::vector<double>(kFftSize);
};

/// The mel spectra of mono samples at 22 050 Hz. Frame f is centred at sample f * hop; there are 1
/// + samples / hop. Audio before and after is silence. Throws Error(kInvalidArgument) for no
/// samples.
std::vector<MelBandsDb> MelSpectrogram(std::span<const float> mono, int hop);

}  // namespace choreo
