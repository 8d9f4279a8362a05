#include "model/audio/mel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "model/audio/format.h"
#include "model/core/error.h"

namespace choreo {
namespace {

constexpr int kBins = kFftSize / 2 + 1;

/// Slaney's scale: linear below 1 kHz (15 mels there), then 27 mels for each factor 6.4.
double MelToHz(double mel) {
  constexpr double kHzPerMel = 200.0 / 3.0;
  constexpr double kCornerHz = 1000.0;
  constexpr double kCornerMel = kCornerHz / kHzPerMel;
  if (mel < kCornerMel) return mel * kHzPerMel;
  return kCornerHz * std::exp((mel - kCornerMel) * std::log(6.4) / 27.0);
}

double HzToMel(double hz) {  // of frequencies above the corner only
  return 15.0 + std::log(hz / 1000.0) * 27.0 / std::log(6.4);
}

/// A triangle over neighbouring Fourier bins.
struct Band {
  size_t first_bin = 0;
  std::vector<double> weights;
};

std::array<Band, kMelBands> MakeBands() {
  constexpr double kNyquist = kModelSampleRate / 2.0;
  std::array<double, kMelBands + 2> corner{};  // Hz
  const double top = HzToMel(kNyquist);
  for (size_t i = 0; i < corner.size(); ++i) {
    corner[i] = MelToHz(top * static_cast<double>(i) / (kMelBands + 1));
  }
  std::array<Band, kMelBands> bands;
  for (size_t b = 0; b < bands.size(); ++b) {
    const double low = corner[b], centre = corner[b + 1], high = corner[b + 2];
    for (int bin = 0; bin < kBins; ++bin) {
      const double hz = kNyquist * bin / (kBins - 1);
      const double height = std::min((hz - low) / (centre - low), (high - hz) / (high - centre));
      if (height <= 0) continue;
      if (bands[b].weights.empty()) bands[b].first_bin = static_cast<size_t>(bin);
      bands[b].weights.push_back(height * 2.0 / (high - low));
    }
  }
  return bands;
}

}  // namespace

double PowerToDb(double power) { return 10.0 * std::log10(std::max(power, 1e-10)); }

struct MelSpectrum::Tables {
  std::array<double, kFftSize> window{};
  std::array<Band, kMelBands> bands = MakeBands();

  Tables() {
    for (int i = 0; i < kFftSize; ++i) {
      window[static_cast<size_t>(i)] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * i / kFftSize);
    }
  }

  static const Tables& Shared() {
    static const Tables tables;
    return tables;
  }
};

MelSpectrum::MelSpectrum() : tables_(Tables::Shared()), fourier_(kFftSize), windowed_(kFftSize) {}

std::span<const double, kMelBands> MelSpectrum::Power(std::span<const float> samples) {
  for (size_t i = 0; i < kFftSize; ++i) {
    windowed_[i] = tables_.window[i] * static_cast<double>(samples[i]);
  }
  const auto spectrum = fourier_.Forward(windowed_);
  // From here on windowed_ holds the power of each bin.
  for (size_t bin = 0; bin < spectrum.size(); ++bin) windowed_[bin] = std::norm(spectrum[bin]);
  for (size_t b = 0; b < power_.size(); ++b) {
    const Band& band = tables_.bands[b];
    double sum = 0;
    for (size_t i = 0; i < band.weights.size(); ++i) {
      sum += band.weights[i] * windowed_[band.first_bin + i];
    }
    power_[b] = sum;
  }
  return power_;
}

MelSpectrogram MelSpectrogramDb(std::span<const float> mono, int hop) {
  if (mono.empty()) throw InvalidArgument("audio", "no samples");
  if (hop < 1) throw InvalidArgument("hop", std::to_string(hop) + " is below 1");
  const int64_t size = static_cast<int64_t>(mono.size());
  MelSpectrogram db(1 + size / hop, kMelBands);
  MelSpectrum spectrum;
  std::vector<float> window(kFftSize);
  for (int64_t frame = 0; frame < db.rows(); ++frame) {
    const int64_t start = frame * hop - kFftSize / 2;
    const int64_t from = std::max<int64_t>(start, 0), to = std::min(start + kFftSize, size);
    std::fill(window.begin(), window.end(), 0.0f);
    if (from < to)
      std::copy(mono.begin() + from, mono.begin() + to, window.begin() + (from - start));
    const auto power = spectrum.Power(window);
    for (int b = 0; b < kMelBands; ++b) db(frame, b) = PowerToDb(power[static_cast<size_t>(b)]);
  }
  return db;
}

}  // namespace choreo
