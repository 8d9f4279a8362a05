#include "model/audio/music/repeat_lag.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/audio/signal/format.h"

namespace choreo {
namespace {

constexpr int kHop = kModelSampleRate / 100;
constexpr double kHop_s = static_cast<double>(kHop) / kModelSampleRate;
constexpr double kMinBand_hz = 40, kMaxBand_hz = kModelSampleRate / 2.0;

int64_t HopOf(double seconds) { return std::llround(seconds / kHop_s); }

}  // namespace

RepeatLag::Bands RepeatLag::LevelsOf(std::span<const float> window) {
  for (size_t i = 0; i < windowed_.size(); ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / kWindow;
    windowed_[i] = static_cast<double>(window[i]) * (0.5 - 0.5 * std::cos(turn));
  }
  const auto powers = fourier_.Of(windowed_);
  Bands levels = Bands::Constant(1e-3F);
  for (size_t bin = 0; bin < powers.size(); ++bin) {
    const double hz = static_cast<double>(bin) * kModelSampleRate / kWindow;
    const double share =
        std::log(std::max(hz, kMinBand_hz) / kMinBand_hz) / std::log(kMaxBand_hz / kMinBand_hz);
    levels[std::min(kBands - 1, static_cast<int>(kBands * share))] +=
        static_cast<float>(powers[bin]);
  }
  return levels.array().log();
}

void RepeatLag::Hear(std::span<const float> mono) {
  mono_.insert(mono_.end(), mono.begin(), mono.end());
  size_t next = 0;
  for (; next + kWindow <= mono_.size(); next += kHop) {
    const Bands levels = LevelsOf(std::span(mono_).subspan(next, kWindow));
    rises_.push_back(rises_.empty() ? Bands(Bands::Zero()) : Bands((levels - before_).cwiseMax(0)));
    before_ = levels;
  }
  mono_.erase(mono_.begin(), mono_.begin() + static_cast<std::ptrdiff_t>(next));
}

double RepeatLag::Near(double lag, double from, double to) const {
  const int64_t last = std::min<int64_t>(HopOf(to), std::ssize(rises_));
  const int64_t middle = HopOf(lag), search = HopOf(kSearch_s);
  double best = lag;
  float most = 0;
  for (int64_t step = 0; step <= 2 * search; ++step) {  // nearest first
    const int64_t hops = middle + (step % 2 == 0 ? step / 2 : -(step + 1) / 2);
    if (hops <= 0) continue;
    float together = 0, then = 1e-6F;
    for (int64_t hop = std::max(HopOf(from), hops); hop < last; ++hop) {
      const Bands& past = rises_[static_cast<size_t>(hop - hops)];
      together += past.dot(rises_[static_cast<size_t>(hop)]);
      then += past.squaredNorm();
    }
    if (const float alike = together / std::sqrt(then); alike > most) {
      most = alike;
      best = static_cast<double>(hops) * kHop_s;
    }
  }
  return best;
}

}  // namespace choreo
