#include "model/audio/repeat_lag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "model/audio/format.h"
#include "model/audio/fourier.h"

namespace choreo {
namespace {

constexpr int kHop = kModelSampleRate / 100, kWindow = 1024;
constexpr double kHop_s = static_cast<double>(kHop) / kModelSampleRate;
constexpr double kMinBand_hz = 40, kMaxBand_hz = kModelSampleRate / 2.0;

int64_t HopOf(double seconds) { return std::llround(seconds / kHop_s); }

}  // namespace

RepeatLag::RepeatLag(std::span<const float> mono) {
  std::array<int, kWindow / 2 + 1> band_of{};
  for (size_t bin = 0; bin < band_of.size(); ++bin) {
    const double hz = static_cast<double>(bin) * kModelSampleRate / kWindow;
    const double share =
        std::log(std::max(hz, kMinBand_hz) / kMinBand_hz) / std::log(kMaxBand_hz / kMinBand_hz);
    band_of[bin] = std::min(kBands - 1, static_cast<int>(kBands * share));
  }
  FourierPower fourier(kWindow);
  std::vector<double> windowed(kWindow);
  Eigen::Matrix<float, kBands, 1> before;
  const auto hops = static_cast<int64_t>(mono.size()) / kHop;
  rises_.setZero(kBands, hops);
  for (int64_t hop = 0; hop < hops; ++hop) {
    const auto first = static_cast<size_t>(hop * kHop);
    for (size_t i = 0; i < windowed.size(); ++i) {
      const double share = 2 * std::numbers::pi * static_cast<double>(i) / kWindow;
      windowed[i] = first + i < mono.size()
                        ? static_cast<double>(mono[first + i]) * (0.5 - 0.5 * std::cos(share))
                        : 0;
    }
    const auto powers = fourier.Of(windowed);
    Eigen::Matrix<float, kBands, 1> level = Eigen::Matrix<float, kBands, 1>::Constant(1e-3F);
    for (size_t bin = 0; bin < powers.size(); ++bin)
      level[band_of[bin]] += static_cast<float>(powers[bin]);
    level = level.array().log();
    if (hop > 0) rises_.col(hop) = (level - before).cwiseMax(0);
    before = level;
  }
}

double RepeatLag::Near(double lag, double from, double to) const {
  const int64_t last = std::min<int64_t>(HopOf(to), rises_.cols());
  const int64_t middle = HopOf(lag), search = HopOf(kSearch_s);
  double best = lag, most = 0;
  for (int64_t step = 0; step <= 2 * search; ++step) {  // nearest first
    const int64_t hops = middle + (step % 2 == 0 ? step / 2 : -(step + 1) / 2);
    const int64_t first = std::max(HopOf(from), hops);
    if (hops <= 0 || first >= last) continue;
    const auto now = rises_.middleCols(first, last - first);
    const auto then = rises_.middleCols(first - hops, last - first);
    const double alike = now.cwiseProduct(then).sum() / (then.norm() + 1e-6F);
    if (alike > most) {
      most = alike;
      best = static_cast<double>(hops) * kHop_s;
    }
  }
  return best;
}

}  // namespace choreo
