#include "model/dance/timeline/spec_poses.h"

#include <algorithm>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// The longest time that is too short to dance away from a pose and back.
constexpr double kHoldSeconds = 0.4;

// Whether a key is the dancer's present pose.
bool IsHeld(const Target& target, const Pose& now) {
  constexpr double kSame = 1e-3;  // radians
  for (Eigen::Index joint = 0; joint < now.rotations.cols(); ++joint) {
    if (!target.mask.Constrains(joint) ||
        RotationDifference(now.rotations.col(joint), target.pose.rotations.col(joint)).norm() >
            kSame)
      return false;
  }
  return true;
}

// Whether a key's position is the dancer's present one.
bool IsThere(const Target& target, const Pose& now) {
  constexpr double kSamePlace = 0.01;  // metres
  return (target.pose.root_position - now.root_position).norm() < kSamePlace;
}

}  // namespace

// The volatile keeps the rounding: GCC 12's SLP vectoriser at -O3 drops double -> float -> double
// of neighbouring numbers, as in Eigen's cast<float>().cast<double>() of a Vector3d.
double ToFloat(double value) {
  volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

bool IsHold(const TransitionSpec& world, double fps) {
  if (!world.target || world.frames >= kHoldSeconds * fps) return false;
  const Pose& now = world.history.back();
  return IsHeld(*world.target, now) &&
         (!world.target->mask.root_position || IsThere(*world.target, now));
}

Pose RoundToFloat(const Pose& pose) {
  return {pose.root_position.unaryExpr(&ToFloat), pose.rotations.unaryExpr(&ToFloat)};
}

std::vector<Pose> FillHistory(const ModelInfo& model, std::span<const Pose> poses) {
  const size_t tau = static_cast<size_t>(model.history_frames);
  const Pose earliest = RoundToFloat(poses.empty() ? StandingPose(model.skeleton) : poses.front());
  std::vector<Pose> history(tau, earliest);
  const std::span<const Pose> newest = poses.last(std::min(tau, poses.size()));
  std::ranges::transform(newest, history.end() - std::ssize(newest), &RoundToFloat);
  return history;
}

std::vector<Pose> CanonicalHistory(const GroundFrame& ground, const std::vector<Pose>& world) {
  std::vector<Pose> local(world.size());
  Pose near{{}, Eigen::Matrix3Xd::Zero(3, world.back().rotations.cols())};
  for (size_t i = world.size(); i-- > 0; near = local[i]) {
    local[i] = ground.ToLocal(world[i]);
    MakeContinuous(local[i], near);
  }
  return local;
}

std::optional<Target> Placed(std::optional<Target> target, const Controls& controls,
                             const Pose& now) {
  if (!target || target->mask.root_position) return target;
  const ControlCurve& path = controls[kRootPath];
  if (path.IsGiven()) {
    target->pose.root_position = path.values.rightCols<1>();
  } else if (IsHeld(*target, now)) {
    target->pose.root_position = now.root_position;
  } else {
    return target;
  }
  target->mask.root_position = true;
  return target;
}

std::optional<RequiredSpeed> RequiredSpeedOf(const TransitionSpec& spec, double fps) {
  if (!spec.target) return std::nullopt;
  const Pose& from = spec.history.back();
  const Target& target = *spec.target;
  const double seconds = spec.frames / fps;
  RequiredSpeed speed;
  // The path, not the key, requested this position, so its error does not count here.
  if (target.mask.root_position && !spec.controls[kRootPath].IsGiven()) {
    speed.root_m_per_s = (target.pose.root_position - from.root_position).norm() / seconds;
  }
  for (int joint = 0; joint < from.rotations.cols(); ++joint) {
    if (!target.mask.Constrains(joint)) continue;
    const double angle =
        RotationDifference(from.rotations.col(joint), target.pose.rotations.col(joint)).norm();
    if (angle / seconds > speed.joint_rad_per_s) {
      speed.joint_rad_per_s = angle / seconds;
      speed.joint = joint;
    }
  }
  return speed;
}

}  // namespace choreo
