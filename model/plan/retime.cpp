#include "model/plan/retime.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

// Catmull-Rom weights at `u` in [0, 1] between the second and the third of four values.
std::array<double, 4> CubicWeights(double u) {
  const double u2 = u * u, u3 = u2 * u;
  return {0.5 * (-u3 + 2 * u2 - u), 0.5 * (3 * u3 - 5 * u2 + 2), 0.5 * (-3 * u3 + 4 * u2 + u),
          0.5 * (u3 - u2)};
}

// Poses in a row as quaternions, and what leads from each to the next: each is needed by four
// frames, and a logarithm costs more than all else.
struct Curve {
  explicit Curve(Eigen::Index joint_count) : joints(joint_count) {}

  void Append(const Pose& pose) {
    positions.push_back(pose.root_position);
    for (Eigen::Index joint = 0; joint < joints; ++joint)
      rotations.push_back(QuaternionFromExp(pose.rotations.col(joint)));
  }
  /// A pose as far behind the last one as that is behind the one before it.
  void GoOn() {
    const size_t last = positions.size() - 1;
    positions.push_back(2 * positions[last] - positions[last - 1]);
    for (Eigen::Index joint = 0; joint < joints; ++joint)
      rotations.push_back(Rotation(last, joint) * Rotation(last - 1, joint).conjugate() *
                          Rotation(last, joint));
  }
  void Connect() {
    for (size_t at = 0; at + 1 < positions.size(); ++at) {
      for (Eigen::Index joint = 0; joint < joints; ++joint)
        steps.push_back(Between(at, at + 1, joint));
    }
  }
  const Eigen::Quaterniond& Rotation(size_t at, Eigen::Index joint) const {
    return rotations[at * static_cast<size_t>(joints) + static_cast<size_t>(joint)];
  }
  /// From pose `at` to the next.
  const Eigen::Vector3d& Step(size_t at, Eigen::Index joint) const {
    return steps[at * static_cast<size_t>(joints) + static_cast<size_t>(joint)];
  }
  Eigen::Vector3d Between(size_t from, size_t to, Eigen::Index joint) const {
    return ExpFromQuaternion(Rotation(from, joint).conjugate() * Rotation(to, joint));
  }

  Eigen::Index joints;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Quaterniond> rotations;  // [poses, joints]
  std::vector<Eigen::Vector3d> steps;         // [poses - 1, joints]
};

}  // namespace

std::vector<Pose> Retime(std::span<const Pose> history, std::span<const Pose> plan,
                         std::span<const double> times) {
  const auto frames = static_cast<int>(plan.size());
  const Eigen::Index joints = history.back().rotations.cols();
  // Two poses in front, and one behind that goes on as the last two go.
  Curve curve(joints);
  curve.Append(history[history.size() > 1 ? history.size() - 2 : 0]);
  curve.Append(history.back());
  for (const Pose& pose : plan) curve.Append(pose);
  curve.GoOn();
  curve.Connect();
  std::vector<Pose> timed(plan.size());
  const Pose* last = &history.back();
  for (int frame = 0; frame < frames; ++frame) {
    const double time = std::clamp(times[static_cast<size_t>(frame)], -1.0, frames - 1.0);
    const int from = std::min(static_cast<int>(std::floor(time)), frames - 2);
    const std::array<double, 4> weights = CubicWeights(time - from);
    const auto at = static_cast<size_t>(from + 2);
    Pose& pose = timed[static_cast<size_t>(frame)];
    pose.root_position.setZero();
    for (size_t i = 0; i < 4; ++i) pose.root_position += weights[i] * curve.positions[at - 1 + i];
    pose.rotations.resize(3, joints);
    for (Eigen::Index joint = 0; joint < joints; ++joint) {
      // In the tangent space of the pose before; back from it leads the step before, turned round.
      const Eigen::Vector3d turn = -weights[0] * curve.Step(at - 1, joint) +
                                   weights[2] * curve.Step(at, joint) +
                                   weights[3] * curve.Between(at, at + 2, joint);
      pose.rotations.col(joint) =
          ExpFromQuaternion(curve.Rotation(at, joint) * QuaternionFromExp(turn));
    }
    MakeContinuous(pose, *last);
    last = &pose;
  }
  return timed;
}

}  // namespace choreo
