#include "model/engine/temperature.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/motion/kinematics.h"
#include "model/motion/velocity.h"

namespace choreo {
namespace {

constexpr double kSlowPower = 1.5;   // of the temperature
constexpr double kLiveliest = 8;     // times as much has the quickest wave of the longest way
constexpr double kSlowShare = 0.25;  // of the components has the slowest
// Between which waves, ways and dancers that lies (docs/decisions.md, 49, 52, 53).
constexpr double kSlowest = 1.0 / 300, kQuickest = 1.0 / 30;  // cycles a frame
constexpr double kShort = 25, kLong = 64;                     // frames
constexpr double kCalm = 5, kRough = 200;                     // m/s^3

constexpr double kFramesPerSecond = 30;
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

double Roughness(const Skeleton& skeleton, std::span<const Pose> history) {
  const double unknown = std::hypot(kSmooth, kUnitNoise);
  if (history.size() < 4) return unknown;
  std::vector<Eigen::Matrix3Xd> positions;
  for (const Pose& pose : history) positions.push_back(JointPositions(skeleton, pose));
  std::vector<double> jerks;
  for (size_t t = 3; t < positions.size(); ++t) {
    for (Eigen::Index joint = 0; joint < positions[t].cols(); ++joint) {
      const auto at = [&](size_t back) { return positions[t - back].col(joint); };
      jerks.push_back(JointJerk(at(3), at(2), at(1), at(0), kFramesPerSecond));
    }
  }
  const auto middle = jerks.begin() + static_cast<std::ptrdiff_t>(jerks.size() / 2);
  std::ranges::nth_element(jerks, middle);
  return *middle < kStandstill ? unknown : *middle;
}

WaveShare ShareOf(const TransitionSpec& spec, double roughness, int wave, int components) {
  const double temperature = spec.temperature;
  if (!Keyed(spec)) return {static_cast<float>(std::sqrt(std::sqrt(temperature))), components};
  const auto share = [](double value, double none, double all) {
    return std::clamp((value - none) / (all - none), 0.0, 1.0);
  };
  const double frequency = (wave + 1) / (2.0 * spec.frames);
  const double gain = share(std::log(frequency), std::log(kSlowest), std::log(kQuickest)) *
                      share(spec.frames, kShort, kLong) * share(temperature, 1, 0.5);
  const double lively = gain * share(std::log(roughness), std::log(kCalm), std::log(kRough));
  const double cooled = std::pow(temperature, kSlowPower) * std::pow(kLiveliest, lively);
  return {static_cast<float>(temperature < 1 ? std::min(1.0, cooled) : temperature),
          static_cast<int>(std::ceil((kSlowShare + (1 - kSlowShare) * gain) * components))};
}

float NoiseShare(const TransitionSpec& spec, double roughness) {
  if (!Keyed(spec)) return 1;
  const double beyond = std::sqrt(std::max(0.0, roughness * roughness - kSmooth * kSmooth));
  const double bound = std::max(1.0, kRoughestTemperature / std::max(spec.temperature, 1e-3F));
  return static_cast<float>(std::min({kRoughest, bound, beyond / kUnitNoise}));
}

}  // namespace choreo
