#include "model/flow/window/turn_prior.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/core/grid.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// Cosine of the largest angle between a turn's axis and the vertical.
constexpr double kUpright = 0.95;
// Units and bounds of the inputs.
constexpr double kAheadFrames = 15;                // for which a dancer is expected to keep turning
constexpr double kMaxDistance = 3;                 // metres in two seconds
constexpr double kTypicalSpeed = 0.02;             // mean joint speed, metres a frame
constexpr double kMinSpeed = 0.05;                 // as a share of that
constexpr size_t kTurnFrames = 2, kWayFrames = 5;  // frames of the history

// The chest's turn relative to the hips about the vertical, radians; 0 for a skeleton without these
// joints.
double TwistOf(const Skeleton& skeleton, const Pose& pose) {
  const int chest = skeleton.Find("spine3");
  if (chest < 0) return 0;
  const JointPlacement at = ForwardKinematics(skeleton, pose);
  return std::remainder(
      Heading(at.rotations[static_cast<size_t>(chest)]) - Heading(at.rotations[0]),
      2 * std::numbers::pi);
}

// The logarithm of mean joint speed over the usual one.
double EnergyOf(const Skeleton& skeleton, const std::vector<Pose>& history) {
  double sum = 0;
  for (size_t i = 1; i < history.size(); ++i) {
    sum += (JointPositions(skeleton, history[i]) - JointPositions(skeleton, history[i - 1]))
               .colwise()
               .norm()
               .mean();
  }
  const auto steps = static_cast<double>(std::max<size_t>(2, history.size()) - 1);
  return std::log(std::max(kMinSpeed, sum / steps / kTypicalSpeed));
}

}  // namespace

Eigen::Vector3d TurnPrior::ShorterTurn(const WindowRequest& request) {
  return RotationDifference(request.history.back().rotations.col(0),
                            request.target->pose.rotations.col(0));
}

std::optional<TurnPrior::Inputs> TurnPrior::Describe(const Skeleton& skeleton,
                                                     const WindowRequest& request) {
  if (!request.target || !request.target->mask.Constrains(0) || request.to_key < 1)
    return std::nullopt;
  const Eigen::Vector3d shorter = ShorterTurn(request), other = OtherWayRound(shorter);
  if (shorter == other) return std::nullopt;  // almost no turn
  const std::vector<Pose>& history = request.history;
  const Pose &last = history.back(), &key = request.target->pose;
  const PoseMask& mask = request.target->mask;
  const Eigen::Vector3d up = UpOf(last);
  // The longer way about other axes would be a somersault.
  if (std::abs(shorter.dot(up)) < kUpright * shorter.norm()) return std::nullopt;
  const double longer = std::log2(request.to_key / double{kTypicalFrames});
  const auto before = [&](size_t frames) -> const Pose& {
    return history[history.size() - 1 - std::min(frames, history.size() - 1)];
  };
  const double turns =
      RotationDifference(before(kTurnFrames).rotations.col(0), last.rotations.col(0)).dot(up);
  const double ahead = std::clamp(turns / kTurnFrames * kAheadFrames / std::numbers::pi, -1.0, 1.0);
  // The canonical frame is the last pose's, so x is sideways.
  const double goes = last.root_position.x() - before(kWayFrames).root_position.x();
  const Eigen::Vector3d way = mask.root_position
                                  ? Eigen::Vector3d((key.root_position - last.root_position) *
                                                    kTypicalFrames / request.to_key)
                                  : Eigen::Vector3d::Zero();
  const double metres = std::min(kMaxDistance, std::hypot(way.x(), way.z()));
  const double twist = mask.joints.empty() ? TwistOf(skeleton, key) : 0;
  const double energy = EnergyOf(skeleton, history);
  const auto describe = [&](const Eigen::Vector3d& turn) {
    const double far = turn.norm() / std::numbers::pi, about = turn.dot(up) / std::numbers::pi;
    Inputs inputs;
    inputs << far, far * longer, far * metres, far * energy, about * ahead, about * ahead * longer,
        about * goes, about * std::clamp(way.x(), -kMaxDistance, kMaxDistance), about * twist;
    return inputs;
  };
  return describe(other) - describe(shorter);
}

double TurnPrior::ChanceOfOther(const Inputs& inputs) const {
  return 1 / (1 + std::exp(-weights.dot(inputs)));
}

std::optional<Eigen::Vector3d> TurnPrior::Sample(const Skeleton& skeleton,
                                                 const WindowRequest& request, double normal,
                                                 double temperature) const {
  const std::optional<Inputs> inputs = known() ? Describe(skeleton, request) : std::nullopt;
  if (!inputs) return std::nullopt;
  // The normal number as a uniform one: 0 becomes a half.
  const double drawn = 0.5 * std::erfc(-std::min(temperature, 1.0) * normal / std::numbers::sqrt2);
  const Eigen::Vector3d shorter = ShorterTurn(request);
  return ChanceOfOther(*inputs) > drawn ? OtherWayRound(shorter) : shorter;
}

}  // namespace choreo
