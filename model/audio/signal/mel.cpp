#include "model/audio/signal/mel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "model/audio/signal/centred_frames.h"
#include "model/audio/signal/format.h"

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

double DecibelsOf(double power) { return 10.0 * std::log10(std::max(power, 1e-10)); }

double HzToMel(double hz) {  // for frequencies above the corner
  return 15.0 + std::log(hz / 1000.0) * 27.0 / std::log(6.4);
}

/// A triangle over neighbouring Fourier bins.
struct Band {
  size_t first_bin = 0;
  std::vector<double> weights;
};

constexpr double kNyquist = kModelSampleRate / 2.0;

double CornerHz(size_t corner) {
  return MelToHz(HzToMel(kNyquist) * static_cast<double>(corner) / (kMelBands + 1));
}

std::array<Band, kMelBands> MakeBands() {
  std::array<Band, kMelBands> bands;
  for (size_t b = 0; b < bands.size(); ++b) {
    const auto [low, centre, high] = MelBandAt(b);
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

struct MelTables {
  std::array<double, kFftSize> window{}, sine{};
  std::array<Band, kMelBands> bands = MakeBands();

  MelTables() {
    for (int i = 0; i < kFftSize; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / kFftSize;
      window[static_cast<size_t>(i)] = 0.5 - 0.5 * std::cos(turn);
      sine[static_cast<size_t>(i)] = std::sin(turn);
    }
  }

  static const MelTables& Shared() {
    static const MelTables tables;
    return tables;
  }
};

/// What the eighths of a window have in common: the mean nearest to 0, or 0 if their signs differ.
double OffsetOf(std::span<const float> samples) {
  constexpr size_t kEighth = kFftSize / 8;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (size_t from = 0; from < samples.size(); from += kEighth) {
    double sum = 0;
    for (const float sample : samples.subspan(from, kEighth)) sum += double{sample};
    least = std::min(least, sum / kEighth);
    most = std::max(most, sum / kEighth);
  }
  return least > 0 ? least : most < 0 ? most : 0;
}

}  // namespace

MelBand MelBandAt(size_t band) { return {CornerHz(band), CornerHz(band + 1), CornerHz(band + 2)}; }

MelBandsDb MelSpectrum::Decibels(std::span<const float> samples) {
  const MelTables& tables = MelTables::Shared();
  for (size_t i = 0; i < kFftSize; ++i) {
    windowed_[i] = tables.window[i] * static_cast<double>(samples[i]);
  }
  powers_ = fourier_.Of(windowed_);
  MelBandsDb db;
  for (size_t b = 0; b < db.size(); ++b) {
    const Band& band = tables.bands[b];
    double power = 0;
    for (size_t i = 0; i < band.weights.size(); ++i) {
      power += band.weights[i] * powers_[band.first_bin + i];
    }
    db[b] = DecibelsOf(power);
  }
  return db;
}

MelBandsDb MelSpectrum::WithoutDc(std::span<const float> samples, MelBandsDb db) const {
  const double offset = OffsetOf(samples.first(kFftSize));
  if (offset == 0) return db;
  // Under a Hann window an offset is bin 0, which no band has, and bin 1, which the first one has.
  const MelTables& tables = MelTables::Shared();
  double re = offset * kFftSize / 4, im = 0;
  for (size_t i = 0; i < kFftSize; ++i) {
    re += windowed_[i] * (1 - 2 * tables.window[i]);
    im += windowed_[i] * tables.sine[i];
  }
  const Band& first = tables.bands[0];
  double power = first.weights[0] * (re * re + im * im);
  for (size_t i = 1; i < first.weights.size(); ++i)
    power += first.weights[i] * powers_[first.first_bin + i];
  db[0] = DecibelsOf(power);
  return db;
}

std::vector<MelBandsDb> MelSpectrogram(std::span<const float> mono, int hop) {
  MelSpectrum spectrum;
  return OfCentredFrames(mono, kFftSize, hop,
                         [&](auto window) { return spectrum.Decibels(window); });
}

}  // namespace choreo
