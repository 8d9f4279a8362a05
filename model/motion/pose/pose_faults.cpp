#include "model/motion/pose/pose_faults.h"

#include <algorithm>
#include <cmath>

#include "model/core/hit.h"
#include "model/core/rounded.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/motion_faults.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kRounding = 0.01;  // degrees of tolerance, for files that contain the limit itself

constexpr double kMaxJumpSeconds = 1.0;  // seconds
constexpr double kLimbSpeed = 7;         // m/s, about the body

// Between standing and less than half of that height, the pelvis of recorded dancers (dancedb, 14
// times down, 15 up) goes at 0.5 m/s (median), and up at 1.04 m/s at most. The fastest tenth
// drops faster than that, which is no way to a pose.
constexpr double kPelvisSpeed = 1, kUsualPelvisSpeed = 0.5;
constexpr double kInstant = 1e-6;  // seconds of tolerance
constexpr double kDeep = 0.3;      // metres: a smaller change of height is no way to the floor

bool AsksForAll(const PoseMask& mask) {
  return mask.root_position && std::ranges::find(mask.joints, false) == mask.joints.end();
}

std::string FloorFault(const Skeleton& skeleton, const Pose& pose, const PoseMask& mask) {
  const Eigen::RowVectorXd depth = FloorClearance(skeleton) - JointPositions(skeleton, pose).row(1);
  const std::vector<bool> known = KnownPlaces(skeleton, mask);
  Eigen::Index deepest = 0;
  for (Eigen::Index joint = 0; joint < depth.cols(); ++joint) {
    if (known[static_cast<size_t>(joint)] && depth[joint] > depth[deepest]) deepest = joint;
  }
  if (depth[deepest] > LimitOf(MotionFaultKind::kUnderFloor)) {
    return skeleton.joint_names[static_cast<size_t>(deepest)] + " is " +
           Rounded(100 * depth[deepest]) + " cm under the floor";
  }
  if (!AsksForAll(mask) || -depth.maxCoeff() <= kMaxJumpHeight) return "";
  return "the body hangs " + Rounded(-depth.maxCoeff()) + " m above the floor; nobody jumps " +
         Rounded(kMaxJumpHeight) + " m";
}

/// Describes the joint that moves fastest relative to the root between two poses, if it is too
/// fast.
std::string SpeedFault(const Skeleton& skeleton, const TimedPose& from, const TimedPose& to) {
  const double seconds = to.seconds - from.seconds;
  if (!(seconds > 0)) return "";
  Eigen::Matrix3Xd way = JointPositions(skeleton, to.pose) - JointPositions(skeleton, from.pose);
  way.colwise() -= way.col(0).eval();
  const std::vector<bool> begins = KnownPlaces(skeleton, from.mask);
  const std::vector<bool> ends = KnownPlaces(skeleton, to.mask);
  Eigen::Index fastest = 0;
  for (Eigen::Index joint = 0; joint < way.cols(); ++joint) {
    const auto i = static_cast<size_t>(joint);
    if (begins[i] && ends[i] && way.col(joint).norm() > way.col(fastest).norm()) fastest = joint;
  }
  const double speed = way.col(fastest).norm() / seconds;
  if (speed <= kLimbSpeed) return "";
  return skeleton.joint_names[static_cast<size_t>(fastest)] + " would go " + Rounded(speed) +
         " m/s about the body from \"" + from.name + "\" to \"" + to.name + "\"; people reach " +
         Rounded(kLimbSpeed);
}

/// The pelvis's height in a pose on the floor, metres; none if it is unknown, or in the air.
std::optional<double> HeightOnFloor(const Skeleton& skeleton, const TimedPose& one) {
  if (!one.mask.root_position) return StandingHeight(skeleton, one.pose, one.mask);
  if (AsksForAll(one.mask) && HeightAboveFloor(skeleton, one.pose) > kInAir) return std::nullopt;
  return one.pose.root_position.y();
}

/// Describes a way to the floor, or from it, for which the time is too short.
std::string PelvisFault(const Skeleton& skeleton, const TimedPose& from, const TimedPose& to) {
  const double seconds = to.seconds - from.seconds;
  const std::optional<double> begins = HeightOnFloor(skeleton, from);
  const std::optional<double> ends = HeightOnFloor(skeleton, to);
  if (!(seconds > 0) || !begins || !ends) return "";
  const double way = std::abs(*ends - *begins);
  if (way < kDeep || way <= kPelvisSpeed * seconds) return "";
  return "the pelvis would " + std::string(*ends < *begins ? "sink " : "rise ") + Rounded(way) +
         " m in " + Rounded(seconds) + " s from \"" + from.name + "\" to \"" + to.name +
         "\"; that takes " + RoundedBeyond(way / kPelvisSpeed, seconds) +
         " s, and dancers usually take " + Rounded(way / kUsualPelvisSpeed);
}

/// Describes a hit whose way to the pose is too short.
std::string HitFault(const TimedPose& from, const TimedPose& to) {
  const double seconds = to.seconds - from.seconds;
  if (!to.hit || *to.hit == 1 || !(seconds > 0) || seconds > kHitSeconds - kInstant) return "";
  return "a hit of " + Rounded(*to.hit) + " shapes the last " + Rounded(kHitSeconds) +
         " s of the way, and from \"" + from.name + "\" to \"" + to.name + "\" are only " +
         Rounded(seconds) + " s, so it hardly shows";
}

}  // namespace

std::vector<std::string> BendFaults(const Skeleton& skeleton, const Pose& pose,
                                    const PoseMask& mask) {
  std::vector<std::string> faults;
  for (const Hinge& hinge : Hinges(skeleton)) {
    if (!mask.Constrains(hinge.joint)) continue;
    const double bend = kDegrees * hinge.axis.dot(pose.rotations.col(hinge.joint));
    const bool backwards = bend < 0;
    const double limit = backwards ? kBrokenBackwards : kFolded;
    if (std::abs(bend) <= limit + kRounding) continue;
    faults.push_back(skeleton.joint_names[static_cast<size_t>(hinge.joint)] + " bends " +
                     RoundedBeyond(std::abs(bend), limit) + " degrees" +
                     (backwards ? " backwards" : "") + ", further than " + Rounded(limit));
  }
  return faults;
}

std::vector<std::string> PoseFaults(const Skeleton& skeleton, const Pose& pose,
                                    const PoseMask& mask) {
  std::vector<std::string> faults;
  if (mask.root_position) faults.push_back(FloorFault(skeleton, pose, mask));
  std::erase(faults, "");
  for (std::string& fault : BendFaults(skeleton, pose, mask)) faults.push_back(std::move(fault));
  return faults;
}

std::string HoldFault(const Skeleton& skeleton, const Pose& pose, const PoseMask& mask,
                      double seconds) {
  if (!AsksForAll(mask)) return "";
  const double height = HeightAboveFloor(skeleton, pose);
  const double jump = 2 * std::sqrt(2 * std::max(0.0, height) / kGravity);  // up and down
  if (height <= kInAir || seconds <= jump) return "";
  return "the body is " + Rounded(height) + " m in the air, where a jump keeps it for " +
         Rounded(jump) + " s, not " + Rounded(seconds) + " s";
}

std::vector<TimedFault> DanceFaults(const Skeleton& skeleton, const std::vector<TimedPose>& poses) {
  const TimedPose start = {"the start", 0, RestPose(skeleton)};
  std::vector<TimedFault> faults;
  size_t in_air = 0;  // poses since the feet left the floor
  for (size_t i = 0; i < poses.size(); ++i) {
    const TimedPose& one = poses[i];
    const TimedPose& before = i > 0 ? poses[i - 1] : start;
    std::string found[] = {i > 0 ? SpeedFault(skeleton, before, one) : "",
                           PelvisFault(skeleton, before, one), HitFault(before, one)};
    for (std::string& fault : found) {
      if (!fault.empty()) faults.push_back({i, true, std::move(fault)});
    }
    in_air = AsksForAll(one.mask) && HeightAboveFloor(skeleton, one.pose) > kInAir ? in_air + 1 : 0;
    if (in_air < 2) continue;
    const TimedPose& left = poses[i + 1 - in_air];
    if (one.seconds - left.seconds <= kMaxJumpSeconds) continue;
    faults.push_back({i, false,
                      "the body would be in the air for " + Rounded(one.seconds - left.seconds) +
                          " s, since \"" + left.name + "\"; a jump takes " +
                          Rounded(kMaxJumpSeconds)});
    in_air = 0;  // report once
  }
  return faults;
}

}  // namespace choreo
