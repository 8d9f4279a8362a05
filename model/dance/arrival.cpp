#include "model/dance/arrival.h"

#include <algorithm>
#include <utility>

#include "model/motion/rotation.h"

namespace choreo {

Arrival::Arrival(Options options, int transition_frames, const Target& target,
                 std::vector<Pose> before, std::optional<Pose> after)
    : options_(options),
      frames_(transition_frames),
      window_(std::min(options.frames, transition_frames)),
      target_(target),
      previous_(before.back()),
      joint_velocity_(Eigen::Matrix3Xd::Zero(3, before.back().rotations.cols())),
      expected_way_(Eigen::Matrix3Xd::Zero(3, before.back().rotations.cols())) {
  if (before.size() > 1) {
    previous_ = before[before.size() - 2];
    Remember(before.back());
  }
  if (after) {
    end_velocity_.emplace();
    end_velocity_->root = after->root_position - target.pose.root_position;
    end_velocity_->joints.resize(3, previous_.rotations.cols());
    for (int joint = 0; joint < previous_.rotations.cols(); ++joint) {
      end_velocity_->joints.col(joint) =
          RotationDifference(target.pose.rotations.col(joint), after->rotations.col(joint));
    }
  }
}

bool Arrival::Asked(int joint) const {
  return target_.mask.joints.empty() || target_.mask.joints[static_cast<size_t>(joint)];
}

void Arrival::Remember(const Pose& emitted) {
  root_velocity_ = emitted.root_position - previous_.root_position;
  for (int joint = 0; joint < emitted.rotations.cols(); ++joint) {
    joint_velocity_.col(joint) =
        RotationDifference(previous_.rotations.col(joint), emitted.rotations.col(joint));
  }
  previous_ = emitted;
}

// With accelerations a_i (i = 0..m-1) added before the steps 1..m, the place after m steps is m v +
// sum (m - i) a_i. The least sum of squares that reaches `way` has a_i proportional to m - i, which
// gives the first term; if the last step must be `end_velocity` as well (sum a_i = end_velocity -
// v), a_i = alpha (m - i) + beta.
Eigen::Vector3d Arrival::Step(const Eigen::Vector3d& way, const Eigen::Vector3d& velocity,
                              const Eigen::Vector3d* end_velocity, int frames_left) {
  const double m = frames_left;
  const double s2 = m * (m + 1) * (2 * m + 1) / 6;
  const Eigen::Vector3d missing = way - m * velocity;
  if (end_velocity == nullptr || frames_left == 1) return velocity + missing * (m / s2);
  const double s1 = m * (m + 1) / 2;
  const Eigen::Vector3d change = *end_velocity - velocity;
  const double determinant = s2 * m - s1 * s1;
  const Eigen::Vector3d alpha = (missing * m - change * s1) / determinant;
  const Eigen::Vector3d beta = (change * s2 - missing * s1) / determinant;
  return velocity + alpha * m + beta;
}

Pose Arrival::Apply(const Pose& raw) {
  const int frame = next_++;
  const int left = frames_ - frame;  // steps to the key, this one included
  if (left > window_) {
    Remember(raw);
    return raw;
  }
  const double x = static_cast<double>(window_ - left + 1) / window_;
  const double w = x * x * (3 - 2 * x);
  Pose emitted = raw;
  if (target_.mask.root_position) {
    const Eigen::Vector3d way = target_.pose.root_position - previous_.root_position;
    const Eigen::Vector3d path =
        previous_.root_position +
        Step(way, root_velocity_, end_velocity_ ? &end_velocity_->root : nullptr, left);
    emitted.root_position += w * (path - raw.root_position);
    if (left == 1) emitted.root_position = target_.pose.root_position;
  }
  for (int joint = 0; joint < raw.rotations.cols(); ++joint) {
    if (!Asked(joint)) continue;
    const Eigen::Vector3d from = previous_.rotations.col(joint);
    Eigen::Vector3d way = RotationDifference(from, target_.pose.rotations.col(joint));
    // Near half a turn the shorter way changes sides with every small step; keep to the one begun.
    if (has_expected_way_) way = NearestBranch(way, expected_way_.col(joint));
    const Eigen::Vector3d end_velocity =
        end_velocity_ ? Eigen::Vector3d(end_velocity_->joints.col(joint)) : Eigen::Vector3d::Zero();
    const Eigen::Vector3d path = RotationCompose(
        from, Step(way, joint_velocity_.col(joint), end_velocity_ ? &end_velocity : nullptr, left));
    const Eigen::Vector3d model = raw.rotations.col(joint);
    emitted.rotations.col(joint) = RotationCompose(model, w * RotationDifference(model, path));
    expected_way_.col(joint) = way - RotationDifference(from, emitted.rotations.col(joint));
  }
  has_expected_way_ = true;
  Remember(emitted);
  return emitted;
}

}  // namespace choreo
