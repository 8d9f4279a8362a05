#include "model/engine/temperature.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/motion/kinematics.h"
#include "model/motion/velocity.h"

namespace choreo {
namespace {

// Powers of the temperature without a key and with one, and how many times as much the quickest
// wave has at most.
constexpr double kFreePower = 0.5, kFreeLiveliest = 2;
constexpr double kKeyedPower = 1.5, kKeyedLiveliest = 8;
constexpr double kSlowShare = 0.25;  // of the components has the slowest
// Between which waves, ways and dancers that lies (docs/decisions.md, 49, 52, 53, 55, 58).
constexpr double kSlowest = 1.0 / 300, kQuickest = 1.0 / 30;  // cycles a frame
constexpr double kShort = 25, kLong = 64;                     // frames
constexpr double kCalm = 5, kRough = 200;                     // m/s^3
constexpr double kBusy = 0.1;                                 // m/s (55)

constexpr double kFramesPerSecond = 30;
constexpr double kSmooth = 50;        // m/s^3: a plan's own median jerk, its feet locked
constexpr double kUnitNoise = 65;     // m/s^3 beyond that: the noise that the model learnt suits
constexpr double kStandstill = 1e-3;  // m/s^3: the same pose again, but for rounding
constexpr double kRoughest = 3, kRoughestTemperature = 0.75;
// On shorter ways, frames, the share counts to a power of up to 2.25 (56).
constexpr double kUnsmoothed = 60, kShortest = 10, kShortPower = 1.25;

}  // namespace

bool Keyed(const TransitionSpec& spec) {
  if (!spec.target) return false;
  const PoseMask& mask = spec.target->mask;
  return mask.root_position || mask.joints.empty() ||
         std::ranges::any_of(mask.joints, [](bool asked) { return asked; });
}

double HalfWaves(int wave, bool keyed) { return wave + (keyed ? 1.0 : 0.5); }

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

double Idleness(const Skeleton& skeleton, const TransitionSpec& spec) {
  if (!Keyed(spec)) return 0;
  const Pose& last = spec.history.back();
  const Pose key = Masked(spec.target->pose, spec.target->mask, last);
  const double way =
      (JointPositions(skeleton, key) - JointPositions(skeleton, last)).colwise().norm().mean();
  return std::max(0.0, 1 - way * kFramesPerSecond / (spec.frames * kBusy));
}

Liveliness LivelinessOf(const Skeleton& skeleton, const TransitionSpec& spec) {
  return {Roughness(skeleton, spec.history), Idleness(skeleton, spec)};
}

WaveShare ShareOf(const TransitionSpec& spec, const Liveliness& liveliness, int wave,
                  int components) {
  const double temperature = spec.temperature;
  const bool keyed = Keyed(spec);
  const auto share = [](double value, double none, double all) {
    return std::clamp((value - none) / (all - none), 0.0, 1.0);
  };
  const auto bounded = [&](double warmed) {
    return static_cast<float>(temperature < 1 ? std::min(1.0, warmed) : temperature);
  };
  const double frequency = HalfWaves(wave, keyed) / (2.0 * spec.frames);
  const double quick = share(std::log(frequency), std::log(kSlowest), std::log(kQuickest));
  const double free = std::pow(temperature, kFreePower) * std::pow(kFreeLiveliest, quick);
  if (!keyed) return {bounded(free), components};
  const double various = share(temperature, 1, 0.5);
  const double gain = quick * share(spec.frames, kShort, kLong) * various;
  const double lively =
      gain * share(std::log(liveliness.roughness), std::log(kCalm), std::log(kRough));
  const double held = std::pow(temperature, kKeyedPower) * std::pow(kKeyedLiveliest, lively);
  const double idleness = liveliness.idleness;
  const double many = std::lerp(kSlowShare, 1.0, std::max(gain, various * idleness));
  return {bounded(std::pow(held, 1 - idleness) * std::pow(free, idleness)),
          static_cast<int>(std::ceil(many * components))};
}

float NoiseShare(const TransitionSpec& spec, double roughness) {
  const double beyond = std::sqrt(std::max(0.0, roughness * roughness - kSmooth * kSmooth));
  if (!Keyed(spec)) return static_cast<float>(std::min(1.0, beyond / kUnitNoise));
  const double bound = std::max(1.0, kRoughestTemperature / std::max(spec.temperature, 1e-3F));
  const double share = std::min({kRoughest, bound, beyond / kUnitNoise});
  const double brevity =
      std::clamp((kUnsmoothed - spec.frames) / (kUnsmoothed - kShortest), 0.0, 1.0);
  return static_cast<float>(std::pow(share, 1 + kShortPower * brevity * brevity));
}

}  // namespace choreo
