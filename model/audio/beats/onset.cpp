#include "model/audio/beats/onset.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "model/audio/signal/centred_frames.h"
#include "model/audio/signal/format.h"
#include "model/audio/signal/fourier.h"

namespace choreo {
namespace {

constexpr double kRangeDb = 50, kFaintestDb = -80;
constexpr double kMinHz = 25, kFirstEdgeHz = 60, kMaxHz = 10500;
constexpr double kBassHz = 160, kMiddleHz = 1600;  // upper edges of the groups

/// The Fourier bins and the group of each band; all bands but the first have equal width in
/// octaves.
template <size_t kBands>
struct OnsetTables {
  std::array<double, kOnsetWindow> window{};
  double window_sum = 0;
  std::array<size_t, kBands> first{}, last{};  // [first, last)
  std::array<size_t, kBands> group{};
  std::array<size_t, Onset::kBands> in_group{};

  OnsetTables() {
    for (size_t i = 0; i < window.size(); ++i) {
      window[i] =
          0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / kOnsetWindow);
      window_sum += window[i];
    }
    const auto edge = [](size_t i) {
      return i == 0 ? kMinHz
                    : kFirstEdgeHz * std::pow(kMaxHz / kFirstEdgeHz,
                                              static_cast<double>(i - 1) / (kBands - 1));
    };
    const auto bin = [](double hz) {
      return static_cast<size_t>(std::lround(hz * kOnsetWindow / kModelSampleRate));
    };
    for (size_t band = 0; band < kBands; ++band) {
      first[band] = std::max<size_t>(1, bin(edge(band)));
      last[band] = std::max(first[band] + 1, bin(edge(band + 1)));
      group[band] = edge(band + 1) < kBassHz ? 0 : edge(band + 1) < kMiddleHz ? 1 : 2;
      ++in_group[group[band]];
    }
  }

  static const OnsetTables& Shared() {
    static const OnsetTables tables;
    return tables;
  }
};

float Mean(std::span<const float> samples) {
  return static_cast<float>(std::accumulate(samples.begin(), samples.end(), 0.0) /
                            static_cast<double>(std::max<size_t>(1, samples.size())));
}

}  // namespace

OnsetMeter::BandsDb OnsetMeter::Decibels(std::span<const float> window) {
  const auto& tables = OnsetTables<kBands>::Shared();
  thread_local FourierPower fourier(kOnsetWindow);
  thread_local std::vector<double> windowed(kOnsetWindow);
  double offset = 0;
  for (size_t i = 0; i < windowed.size(); ++i) offset += tables.window[i] * double{window[i]};
  offset /= tables.window_sum;
  for (size_t i = 0; i < windowed.size(); ++i)
    windowed[i] = tables.window[i] * (double{window[i]} - offset);
  const auto powers = fourier.Of(windowed);
  constexpr double kFullScale = double{kOnsetWindow} * kOnsetWindow / 16;
  BandsDb db;
  for (size_t band = 0; band < kBands; ++band) {
    double power = 0;
    for (size_t k = tables.first[band]; k < tables.last[band]; ++k) power += powers[k];
    db[band] = 10 * std::log10(std::max(power / kFullScale, 1e-10));
  }
  return db;
}

Onset OnsetMeter::Add(std::span<const float> window) {
  const auto& tables = OnsetTables<kBands>::Shared();
  const BandsDb db = Decibels(window);
  const double loudest = *std::ranges::max_element(db);
  loudest_[frames_ % kLoudFrames] = loudest;
  const auto known = static_cast<std::ptrdiff_t>(std::min(frames_ + 1, kLoudFrames));
  const double floor = std::max(
      *std::max_element(loudest_.begin(), loudest_.begin() + known) - kRangeDb, kFaintestDb);
  Onset onset{.loud_db = static_cast<float>(loudest)};
  BandsDb& before = before_[frames_ % kRise];
  std::array<double, Onset::kBands> sums{};
  for (size_t band = 0; band < kBands; ++band) {
    if (frames_ >= kRise)
      sums[tables.group[band]] += std::max(0.0, db[band] - std::max(before[band], floor));
    before[band] = db[band];
  }
  for (size_t group = 0; group < sums.size(); ++group)
    onset.rise[group] =
        static_cast<float>(sums[group] / static_cast<double>(tables.in_group[group]));
  ++frames_;
  return onset;
}

std::vector<Onset> FindOnsets(std::span<const float> mono) {
  OnsetMeter meter;
  const auto second = std::min<size_t>(mono.size(), kModelSampleRate);
  return OfCentredFrames(
      mono, kOnsetWindow, kOnsetHop, [&](auto window) { return meter.Add(window); },
      Mean(mono.first(second)), Mean(mono.last(second)));
}

std::vector<float> OnsetStrength(std::span<const Onset> onsets) {
  std::vector<float> strength;
  for (const Onset& onset : onsets)
    strength.push_back((2 * onset.rise[0] + onset.rise[1] + onset.rise[2]) / 4);
  return strength;
}

}  // namespace choreo
