#include "model/metrics/groove.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/metrics/band_filter.h"
#include "model/metrics/joint_track.h"
#include "model/motion/kinematics/limb.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

std::vector<Eigen::Index> LimbEnds(const Skeleton& skeleton) {
  std::vector<Eigen::Index> ends;
  for (const int bend :
       {skeleton.left_knee, skeleton.right_knee, skeleton.left_elbow, skeleton.right_elbow}) {
    const auto child = std::ranges::find(skeleton.parents, bend);
    if (bend < 0 || child == skeleton.parents.end())
      throw InvalidArgument("skeleton", skeleton.Describe() + " lacks knees, elbows or their ends");
    ends.push_back(child - skeleton.parents.begin());
  }
  return ends;
}

constexpr double kSpeed = 240 / kDegrees;  // per second

// The angle between the bones above and below a hinge.
double Flexion(const Hinge& hinge, int lower, const Eigen::Matrix3Xd& joints) {
  const Eigen::Vector3d above = joints.col(hinge.joint) - joints.col(hinge.upper);
  const Eigen::Vector3d below = joints.col(lower) - joints.col(hinge.joint);
  return std::atan2(above.cross(below).norm(), above.dot(below));
}

}  // namespace

LimbTravel MeasureLimbTravel(const Skeleton& skeleton, const JointTrack& track,
                             const std::vector<int>& keys) {
  LimbTravel travel;
  for (const Eigen::Index joint : LimbEnds(skeleton)) {
    size_t from = 0;
    for (const int key : keys) {
      const auto to = static_cast<size_t>(key);
      for (size_t t = from; t < to; ++t)
        travel.path += (track[t + 1].col(joint) - track[t].col(joint)).norm();
      travel.chord += (track[to].col(joint) - track[from].col(joint)).norm();
      from = to;
    }
  }
  return travel;
}

double PelvisBounce(const JointTrack& track, double fps) {
  Eigen::VectorXd heights(static_cast<Eigen::Index>(track.size()));
  for (Eigen::Index t = 0; t < heights.size(); ++t) heights[t] = track[t](1, 0);
  if (heights.size() == 0) return 0;
  const Eigen::VectorXd quick = heights - LowPass(heights, fps, kBounceHz);
  return std::sqrt(quick.squaredNorm() / static_cast<double>(heights.size()));
}

double SmoothJerk(const JointTrack& track, double fps) {
  return RawJerk(LowPass(track, fps, kJerkHz), fps);
}

double RawJerk(const JointTrack& track, double fps) {
  Pace pace;
  pace.Add(track, fps);
  return pace.median_jerk();
}

Snaps CountSnaps(const Skeleton& skeleton, double fps, const JointTrack& track) {
  Snaps snaps;
  for (const Hinge& hinge : Hinges(skeleton)) {
    const auto lower = std::ranges::find(skeleton.parents, hinge.joint);
    if (lower == skeleton.parents.end()) continue;
    const auto end = static_cast<int>(lower - skeleton.parents.begin());
    const bool knee = hinge.joint == skeleton.left_knee || hinge.joint == skeleton.right_knee;
    for (size_t t = 1; t < track.size(); ++t) {
      const double before = Flexion(hinge, end, track[t - 1]);
      const double now = Flexion(hinge, end, track[t]);
      if (std::min(before, now) < kStraightBend && std::abs(now - before) * fps > kSpeed)
        ++(knee ? snaps.knees : snaps.elbows);
    }
  }
  return snaps;
}

double PhysicalFootContact(const Skeleton& skeleton, const JointTrack& track) {
  if (std::ranges::min(skeleton.feet) < 0)
    throw InvalidArgument("skeleton", "lacks a foot joint, which PFC needs");
  double sum = 0, largest = 0;
  int64_t frames = 0;
  for (size_t t = 1; t + 1 < track.size(); ++t, ++frames) {
    // The unit is per frame squared: the rate cancels in |a| / max|a|.
    Eigen::Vector3d acceleration = track[t + 1].col(0) - 2 * track[t].col(0) + track[t - 1].col(0);
    acceleration.y() = std::max(acceleration.y(), 0.0);
    const auto way = [&](int joint) {
      const Eigen::Vector3d step = track[t + 1].col(joint) - track[t].col(joint);
      return std::hypot(step.x(), step.z());
    };
    const double left = std::min(way(skeleton.feet[0]), way(skeleton.feet[1]));
    const double right = std::min(way(skeleton.feet[2]), way(skeleton.feet[3]));
    largest = std::max(largest, acceleration.norm());
    sum += acceleration.norm() * left * right;
  }
  return largest > 0 ? 1e4 * sum / (largest * frames) : 0;
}

}  // namespace choreo
