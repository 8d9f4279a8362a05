#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "model/motion/kinematics/trunk_line.h"
#include "model/motion/rotation.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr uint64_t kWristNoise = 0x7772697374;  // "wrist": no number that the sampler draws, too
constexpr int kNormals = 6;                     // of a wrist in a frame: two for each axis

struct Wrist {
  int shoulder, elbow, joint;
  Matrix3d axes;  // columns, in the joint's frame: twist, deviation, flexion; mirrored at the right
};

// A wrist's angle about one axis, radians, and its rate by the arm's way: a critically damped
// process with Gaussian noise, whose state after any way is Gaussian, too.
class Angle {
 public:
  Angle(double spread, double memory, double angle, double rate)
      : spread_(spread), decay_(1 / memory), state_(angle, rate) {}

  void Move(double way, double first, double second) {
    const double passed = decay_ * way;
    const Matrix2d fading =
        std::exp(-passed) * Matrix2d{{1 + passed, way}, {-decay_ * passed, 1 - passed}};
    const Vector2d usual(spread_, spread_ * decay_);
    const Matrix2d old = fading * usual.asDiagonal();
    const Matrix2d fresh =
        Matrix2d(usual.array().square().matrix().asDiagonal()) - old * old.transpose();
    state_ = fading * state_;
    const double side = std::sqrt(std::max(fresh(0, 0), 0.0));
    if (side == 0) return;
    const double shared = fresh(0, 1) / side;
    state_ +=
        Vector2d(side * first,
                 shared * first + std::sqrt(std::max(fresh(1, 1) - shared * shared, 0.0)) * second);
  }

  double value() const { return state_[0]; }

 private:
  double spread_, decay_;
  Vector2d state_;
};

double Way(const Wrist& wrist, const Pose& from, const Pose& to) {
  double way = 0;
  for (const int joint : {wrist.shoulder, wrist.elbow})
    way += RotationDifference(from.rotations.col(joint), to.rotations.col(joint)).norm();
  return way;
}

void Turn(const PlanContext& context, const Wrist& wrist, size_t first_normal,
          std::vector<Pose>* plan) {
  const WristOptions& options = context.options.wrists;
  const Vector3d spread(options.twist, options.deviation, options.flexion);
  const auto turn = [&](const Pose& pose) -> Vector3d {
    return wrist.axes.transpose() * LogMap(ExpMap(pose.rotations.col(wrist.joint)));
  };
  const Pose* before = &context.history.back();
  Vector3d rate = Vector3d::Zero();
  if (context.history.size() > 1) {
    const Pose& earlier = context.history[context.history.size() - 2];
    // An arm slower than 1 rad/s tells nothing of the rate.
    const double way = std::max(Way(wrist, earlier, *before), 1 / context.fps);
    const Vector3d step =
        wrist.axes.transpose() *
        RotationDifference(earlier.rotations.col(wrist.joint), before->rotations.col(wrist.joint));
    // A hand that waves by itself does not go on once its arm moves.
    const Vector3d most = 3 * spread / options.memory;
    rate = (step / way).cwiseMax(-most).cwiseMin(most);
  }
  std::vector<Angle> angles;
  for (int axis = 0; axis < 3; ++axis)
    angles.emplace_back(spread[axis], options.memory, turn(*before)[axis], rate[axis]);
  std::vector<float> normals(first_normal + kNormals);
  TransitionNoise noise = context.noise;
  noise.seed ^= kWristNoise;
  const double temperature = std::min(noise.temperature, 1.0);
  for (size_t at = 0; at < plan->size(); ++at) {
    Pose& pose = (*plan)[at];
    const double way = Way(wrist, *before, pose);
    noise.FillNoise(static_cast<int>(at), normals);
    Vector3d turned;
    for (int axis = 0; axis < 3; ++axis) {
      const float* normal = &normals[first_normal + 2 * static_cast<size_t>(axis)];
      Angle& angle = angles[static_cast<size_t>(axis)];
      angle.Move(way, temperature * normal[0], temperature * normal[1]);
      turned[axis] = angle.value();
    }
    pose.rotations.col(wrist.joint) = wrist.axes * turned;
    before = &pose;
  }
}

}  // namespace

void TurnWrists(const PlanContext& context, std::vector<Pose>* plan) {
  const Skeleton& skeleton = context.skeleton;
  const std::vector<Arm> arms = ArmsOf(skeleton);
  for (size_t side = 0; side < arms.size(); ++side) {
    const Arm& arm = arms[side];
    const Vector3d along = skeleton.offsets.col(arm.wrist).normalized();
    if (along.isZero()) continue;
    const Vector3d above = std::abs(along.y()) < 0.9 ? Vector3d::UnitY() : Vector3d::UnitX();
    const Vector3d up = (above - above.dot(along) * along).normalized();
    const double mirrored = side == 0 ? 1 : -1;
    Matrix3d axes;
    axes << mirrored * along, mirrored * up, along.cross(up);
    Turn(context, {arm.shoulder, arm.elbow, arm.wrist, axes}, side * kNormals, plan);
  }
}

}  // namespace choreo
