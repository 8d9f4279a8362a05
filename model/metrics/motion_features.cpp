#include "model/metrics/motion_features.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr int64_t kReach = 2;  // frames to either side
constexpr int kGeometricFeatures = 32;

// Means over a sliding window, shorter at the ends.
JointTrack Smooth(const JointTrack& track) {
  const auto frames = static_cast<int64_t>(track.size());
  JointTrack smooth;
  for (int64_t t = 0; t < frames; ++t) {
    const int64_t first = std::max<int64_t>(0, t - kReach);
    const int64_t last = std::min(frames - 1, t + kReach);
    Eigen::Matrix3Xd sum = track[first];
    for (int64_t i = first + 1; i <= last; ++i) sum += track[i];
    smooth.push_back(sum / static_cast<double>(last - first + 1));
  }
  return smooth;
}

JointTrack Differences(const JointTrack& track, double fps) {
  JointTrack steps;
  for (size_t t = 1; t < track.size(); ++t) steps.push_back((track[t] - track[t - 1]) * fps);
  return steps;
}

using Eigen::Vector3d;

// The joints that statements use.
struct Body {
  int root = 0, chest, neck, belly;
  int left_shoulder, right_shoulder, left_elbow, right_elbow, left_wrist, right_wrist;
  int left_hip, right_hip, left_knee, right_knee, left_ankle, right_ankle, left_toes, right_toes;
  double upper_arm, shoulders, hips;  // metres at rest

  explicit Body(const Skeleton& skeleton) {
    chest = skeleton.Find("spine3"), neck = skeleton.Find("neck"), belly = skeleton.Find("spine1");
    left_shoulder = skeleton.left_shoulder, right_shoulder = skeleton.right_shoulder;
    left_elbow = skeleton.left_elbow, right_elbow = skeleton.right_elbow;
    left_wrist = skeleton.Find("left_wrist"), right_wrist = skeleton.Find("right_wrist");
    left_hip = skeleton.left_hip, right_hip = skeleton.right_hip;
    left_knee = skeleton.left_knee, right_knee = skeleton.right_knee;
    left_ankle = skeleton.feet[0], right_ankle = skeleton.feet[2];
    left_toes = skeleton.feet[1], right_toes = skeleton.feet[3];
    const auto rest = [&](int joint) {
      Vector3d at = Vector3d::Zero();
      for (; joint >= 0; joint = skeleton.parents[joint]) at += skeleton.offsets.col(joint);
      return at;
    };
    upper_arm = (rest(left_shoulder) - rest(left_elbow)).norm();
    shoulders = (rest(left_shoulder) - rest(right_shoulder)).norm();
    hips = (rest(left_hip) - rest(right_hip)).norm();
  }

  bool Whole() const {
    return std::min({chest, neck, belly, left_shoulder, right_shoulder, left_elbow, right_elbow,
                     left_wrist, right_wrist, left_hip, right_hip, left_knee, right_knee,
                     left_ankle, right_ankle, left_toes, right_toes}) >= 0;
  }
};

// Two frames, and the statements about them.
class Statements {
 public:
  Statements(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& now, double fps)
      : now_(now), velocity_((now - before) * fps) {}

  Vector3d Between(int from, int to) const { return now_.col(to) - now_.col(from); }
  // Above the lowest joint.
  double Height(int joint) const { return now_(1, joint) - now_.row(1).minCoeff(); }

  // `joint` is further than `limit` in front of the plane through three joints.
  bool BeyondPlane(int a, int b, int c, int joint, double limit) const {
    return Unit(Between(a, b).cross(Between(a, c))).dot(Between(a, joint)) > limit;
  }
  // The same for the plane through joint `point` with a normal from `a` to `b`.
  bool Beyond(int a, int b, int point, int joint, double limit) const {
    return Unit(Between(a, b)).dot(Between(point, joint)) > limit;
  }
  // `joint` moves faster than `limit`, relative to joint `from`, in the direction from a to b.
  bool Moves(int a, int b, int from, int joint, double limit) const {
    return Unit(Between(a, b)).dot(Relative(joint, from)) > limit;
  }
  // The same in the direction of the normal of the plane through three joints.
  bool MovesFromPlane(int a, int b, int c, int joint, double limit) const {
    return Unit(Between(a, b).cross(Between(a, c))).dot(Relative(joint, a)) > limit;
  }
  bool Fast(int joint, double limit) const { return velocity_.col(joint).norm() > limit; }
  // The angle between two directions lies between the limits, degrees.
  static bool Angle(const Vector3d& a, const Vector3d& b, double low, double high) {
    const double degrees = std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
    return degrees > low && degrees < high;
  }
  bool Bent(int upper, int hinge, int lower, double high) const {
    return Angle(hinge, upper, hinge, lower, 0, high);
  }
  // The same for the angle between a-b and c-d.
  bool Angle(int a, int b, int c, int d, double low, double high) const {
    return Angle(Between(a, b), Between(c, d), low, high);
  }

 private:
  static Vector3d Unit(const Vector3d& v) {
    const double length = v.norm();
    return length > 1e-9 ? Vector3d(v / length) : Vector3d::Zero();
  }
  Vector3d Relative(int joint, int from) const {
    return velocity_.col(joint) - velocity_.col(from);
  }

  const Eigen::Matrix3Xd& now_;
  Eigen::Matrix3Xd velocity_;
};

std::array<bool, kGeometricFeatures> Judge(const Body& b, const Statements& s) {
  const double arm = b.upper_arm;
  return {
      // Hands: to the front, above the neck, upwards; elbows bent; hands apart, together, to the
      // root; fast.
      s.MovesFromPlane(b.neck, b.right_hip, b.left_hip, b.right_wrist, 1.8 * arm),
      s.MovesFromPlane(b.neck, b.left_hip, b.right_hip, b.left_wrist, 1.8 * arm),
      s.Beyond(b.chest, b.neck, b.neck, b.right_wrist, 0.2 * arm),
      s.Beyond(b.chest, b.neck, b.neck, b.left_wrist, 0.2 * arm),
      s.Moves(b.belly, b.chest, b.chest, b.right_wrist, 1.8 * arm),
      s.Moves(b.belly, b.chest, b.chest, b.left_wrist, 1.8 * arm),
      s.Bent(b.right_shoulder, b.right_elbow, b.right_wrist, 110),
      s.Bent(b.left_shoulder, b.left_elbow, b.left_wrist, 110),
      s.Beyond(b.left_shoulder, b.right_shoulder, b.left_wrist, b.right_wrist, 2.5 * b.shoulders),
      s.Moves(b.left_wrist, b.right_wrist, b.left_wrist, b.right_wrist, 1.4 * arm),
      s.Moves(b.right_wrist, b.root, b.root, b.right_wrist, 1.4 * arm),
      s.Moves(b.left_wrist, b.root, b.root, b.left_wrist, 1.4 * arm),
      s.Fast(b.right_wrist, 2.5 * arm),
      s.Fast(b.left_wrist, 2.5 * arm),
      // Feet: in front of the other leg, raised, apart; knees bent; fast.
      s.BeyondPlane(b.root, b.left_hip, b.left_toes, b.right_ankle, 0.38 * arm),
      s.BeyondPlane(b.root, b.right_hip, b.right_toes, b.left_ankle, 0.38 * arm),
      s.Height(b.right_ankle) > 1.2 * arm,
      s.Height(b.left_ankle) > 1.2 * arm,
      s.Beyond(b.left_hip, b.right_hip, b.left_ankle, b.right_ankle, 2.1 * b.hips),
      s.Bent(b.right_hip, b.right_knee, b.right_ankle, 110),
      s.Bent(b.left_hip, b.left_knee, b.left_ankle, 110),
      s.Fast(b.right_ankle, 2.5 * arm),
      s.Fast(b.left_ankle, 2.5 * arm),
      // Arms and thighs away from the trunk; legs crossed; trunk level; hands near the floor; the
      // whole body fast.
      s.Angle(b.neck, b.root, b.right_shoulder, b.right_elbow, 25, 180),
      s.Angle(b.neck, b.root, b.left_shoulder, b.left_elbow, 25, 180),
      s.Angle(b.neck, b.root, b.right_hip, b.right_knee, 50, 180),
      s.Angle(b.neck, b.root, b.left_hip, b.left_knee, 50, 180),
      s.BeyondPlane(b.right_ankle, b.neck, b.left_ankle, b.root, 0.5 * arm),
      Statements::Angle(s.Between(b.neck, b.root), Vector3d::UnitY(), 70, 110),
      s.Height(b.right_wrist) < 1.2 * arm,
      s.Height(b.left_wrist) < 1.2 * arm,
      s.Fast(b.root, 2.3 * arm),
  };
}

}  // namespace

Eigen::VectorXd KineticFeatures(const JointTrack& track, double fps) {
  const JointTrack steps = Differences(track, fps);
  const JointTrack velocities = Smooth(steps), accelerations = Smooth(Differences(steps, fps));
  const Eigen::Index joints = track[0].cols();
  Eigen::VectorXd features = Eigen::VectorXd::Zero(3 * joints);
  for (const Eigen::Matrix3Xd& velocity : velocities) {
    for (Eigen::Index j = 0; j < joints; ++j) {
      const double vertical = velocity(1, j) * velocity(1, j);
      features[3 * j] += velocity.col(j).squaredNorm() - vertical;
      features[3 * j + 1] += vertical;
    }
  }
  for (Eigen::Index j = 0; j < joints; ++j) {
    features.segment<2>(3 * j) /= static_cast<double>(velocities.size());
    for (const Eigen::Matrix3Xd& acceleration : accelerations)
      features[3 * j + 2] += acceleration.col(j).norm();
    features[3 * j + 2] /= static_cast<double>(accelerations.size());
  }
  return features;
}

bool HasGeometricFeatures(const Skeleton& skeleton) { return Body(skeleton).Whole(); }

Eigen::VectorXd GeometricFeatures(const Skeleton& skeleton, const JointTrack& track, double fps) {
  const Body body(skeleton);
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(kGeometricFeatures);
  for (size_t t = 1; t < track.size(); ++t) {
    const auto judged = Judge(body, Statements(track[t - 1], track[t], fps));
    for (int i = 0; i < kGeometricFeatures; ++i) shares[i] += judged[i];
  }
  return shares / static_cast<double>(track.size() - 1);
}

}  // namespace choreo
