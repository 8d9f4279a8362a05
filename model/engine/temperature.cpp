#include "model/engine/temperature.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/motion/velocity.h"

namespace choreo {
namespace {

// Powers of the temperature, and between which waves and ways they lie (docs/decisions.md, 49).
constexpr double kSlowPower = 1.5, kQuickGain = 1.3;
constexpr double kSlowest = 1.0 / 300, kQuickest = 1.0 / 30;  // cycles a frame
constexpr double kShort = 25, kLong = 64;                     // frames
constexpr double kSlowShare = 0.25;                           // of the components

constexpr double kSmooth = 50;        // m/s^3: a plan's own median jerk, its feet locked
constexpr double kUnitNoise = 65;     // m/s^3 beyond that: the noise that the model learnt suits
constexpr double kStandstill = 1e-3;  // m/s^3: the same pose again, but for rounding
constexpr double kRoughest = 3, kRoughestTemperature = 0.75;

}  // namespace

bool Keyed(const TransitionSpec& spec) {
  if (!spec.target) return false;
  const PoseMask& mask = spec.target->mask;
  return mask.root_position || mask.joints.empty() ||
         std::ranges::any_of(mask.joints, [](bool asked) { return asked; });
}

WaveShare ShareOf(const TransitionSpec& spec, int wave, int components) {
  const double temperature = spec.temperature;
  if (!Keyed(spec)) return {static_cast<float>(std::sqrt(std::sqrt(temperature))), components};
  const double frequency = (wave + 1) / (2.0 * spec.frames);
  const double quick = std::log(frequency / kSlowest) / std::log(kQuickest / kSlowest);
  const double longer = (spec.frames - kShort) / (kLong - kShort);
  const double cooled = std::clamp(2 - 2 * temperature, 0.0, 1.0);
  const double gain = std::clamp(quick, 0.0, 1.0) * std::clamp(longer, 0.0, 1.0) * cooled;
  const double power = temperature < 1 ? kSlowPower - kQuickGain * gain : 1;
  return {static_cast<float>(std::pow(temperature, power)),
          static_cast<int>(std::ceil((kSlowShare + (1 - kSlowShare) * gain) * components))};
}

float NoiseShare(const TransitionSpec& spec, std::span<const JointPlacement> history, double fps) {
  if (!Keyed(spec) || history.size() < 4) return 1;
  std::vector<double> jerks;
  for (size_t t = 3; t < history.size(); ++t) {
    for (Eigen::Index joint = 0; joint < history[t].positions.cols(); ++joint) {
      const auto at = [&](size_t back) { return history[t - back].positions.col(joint); };
      jerks.push_back(JointJerk(at(3), at(2), at(1), at(0), fps));
    }
  }
  const auto middle = jerks.begin() + static_cast<std::ptrdiff_t>(jerks.size() / 2);
  std::ranges::nth_element(jerks, middle);
  if (*middle < kStandstill) return 1;
  const double beyond = std::sqrt(std::max(0.0, *middle * *middle - kSmooth * kSmooth));
  const double bound = std::max(1.0, kRoughestTemperature / std::max(spec.temperature, 1e-3F));
  return static_cast<float>(std::min({kRoughest, bound, beyond / kUnitNoise}));
}

}  // namespace choreo
