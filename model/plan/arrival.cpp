#include "model/plan/arrival.h"

#include <algorithm>

#include "model/core/numbers/smooth_step.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// Share of the window after which the path alone determines the poses. An early share spreads the
// correction over more frames. For a 15 cm miss, 2/3 lowers the peak acceleration by a quarter
// compared with a weight that reaches 1 only at the key; 1/2 lowers it by a third, but ignores the
// model in half of the window.
constexpr double kFull = 2.0 / 3;

// Weight of the newest frame in the model's velocity.
constexpr double kNewest = 0.3;

}  // namespace

Arrival::Arrival(int window, int transition_frames, const Target& target,
                 const std::vector<Pose>& before, const std::optional<Pose>& after, Lead lead)
    : left_(transition_frames),
      window_(lead == Lead::kAlone ? transition_frames : std::min(window, transition_frames)),
      lead_(lead),
      target_(target),
      previous_(before.back()),
      velocity_(
          Between(before.size() > 1 ? before[before.size() - 2] : before.back(), before.back())),
      last_raw_(before.back()),
      model_velocity_(velocity_),
      expected_way_(Eigen::Matrix3Xd::Zero(3, before.back().rotations.cols())) {
  if (after) after_ = Between(target.pose, *after);
}

Arrival::Velocity Arrival::Between(const Pose& a, const Pose& b) {
  Velocity velocity{b.root_position - a.root_position, Eigen::Matrix3Xd(3, a.rotations.cols())};
  for (int joint = 0; joint < a.rotations.cols(); ++joint) {
    velocity.joints.col(joint) = RotationDifference(a.rotations.col(joint), b.rotations.col(joint));
  }
  return velocity;
}

// With accelerations a_i (i = 0..m-1) added before steps 1..m, the position after m steps is m v +
// sum (m - i) a_i, and the velocity v + sum a_i. The least sum of squares that reaches both has a_i
// = alpha (m - i) + beta.
Eigen::Vector3d Arrival::Step(const Eigen::Vector3d& way, const Eigen::Vector3d& velocity,
                              const Eigen::Vector3d& end_velocity, int frames_left) {
  if (frames_left == 1) return way;
  const double m = frames_left;
  const double s1 = m * (m + 1) / 2;
  const double s2 = m * (m + 1) * (2 * m + 1) / 6;
  const double determinant = s2 * m - s1 * s1;
  const Eigen::Vector3d missing = way - m * velocity;
  const Eigen::Vector3d change = end_velocity - velocity;
  const Eigen::Vector3d alpha = (missing * m - change * s1) / determinant;
  const Eigen::Vector3d beta = (change * s2 - missing * s1) / determinant;
  return velocity + alpha * m + beta;
}

Pose Arrival::Apply(const Pose& raw) {
  const Velocity newest = Between(last_raw_, raw);
  model_velocity_.root += kNewest * (newest.root - model_velocity_.root);
  model_velocity_.joints += kNewest * (newest.joints - model_velocity_.joints);
  last_raw_ = raw;
  Pose emitted = left_ > window_ ? raw : Steered(raw);
  velocity_ = Between(previous_, emitted);
  previous_ = emitted;
  --left_;
  return emitted;
}

Pose Arrival::Steered(const Pose& raw) {
  const double w = lead_ == Lead::kAlone
                       ? 1
                       : SmoothStep(std::min(1.0, (window_ - left_ + 1) / (kFull * window_)));
  Pose emitted = raw;
  const Velocity& end_velocity = after_ ? *after_ : model_velocity_;
  const bool has_place = target_.mask.root_position;
  Eigen::Vector3d place = target_.pose.root_position;
  if (!has_place && target_.height) place.y() = *target_.height;
  const Eigen::Vector3d way_there = place - previous_.root_position;
  const Eigen::Vector3d path_there =
      previous_.root_position + Step(way_there, velocity_.root, end_velocity.root, left_);
  const Eigen::Vector3d coasting =
      previous_.root_position + velocity_.root + (end_velocity.root - velocity_.root) / left_;
  for (int axis = 0; axis < 3; ++axis) {
    double& at = emitted.root_position[axis];
    if (has_place || (axis == 1 && target_.height)) {
      at = left_ == 1 ? place[axis] : at + w * (path_there[axis] - at);
    } else if (after_) {
      at += w * (coasting[axis] - at);
    }
  }
  for (int joint = 0; joint < raw.rotations.cols(); ++joint) {
    if (!target_.mask.Constrains(joint)) continue;
    const Eigen::Vector3d from = previous_.rotations.col(joint);
    const Eigen::Vector3d model = raw.rotations.col(joint);
    Eigen::Vector3d way = RotationDifference(from, target_.pose.rotations.col(joint));
    // Near half a turn, small steps change which way is shorter, so keep the first choice.
    if (has_expected_way_) way = NearestBranch(way, expected_way_.col(joint));
    const Eigen::Vector3d path = RotationCompose(
        from, Step(way, velocity_.joints.col(joint), end_velocity.joints.col(joint), left_));
    emitted.rotations.col(joint) = RotationCompose(model, w * RotationDifference(model, path));
    expected_way_.col(joint) = way - RotationDifference(from, emitted.rotations.col(joint));
  }
  has_expected_way_ = true;
  return emitted;
}

}  // namespace choreo
