#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "model/motion/rotation.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

// Catmull-Rom weights at `u` in [0, 1] between the second and the third of four values.
std::array<double, 4> CubicWeights(double u) {
  const double u2 = u * u, u3 = u2 * u;
  return {0.5 * (-u3 + 2 * u2 - u), 0.5 * (3 * u3 - 5 * u2 + 2), 0.5 * (-3 * u3 + 4 * u2 + u),
          0.5 * (u3 - u2)};
}

// Poses as quaternions, with the steps between them cached: four frames need each, and its
// logarithm dominates the cost.
struct Curve {
  using Rotations = std::vector<Eigen::Quaterniond>;  // by joint

  void Append(const Eigen::Vector3d& position, Rotations rotation) {
    positions.push_back(position);
    rotations.push_back(std::move(rotation));
    const size_t last = positions.size() - 1;
    if (last == 0) return;
    auto& step = steps.emplace_back();
    for (size_t joint = 0; joint < rotations[last].size(); ++joint)
      step.push_back(Between(last - 1, last, joint));
  }
  void Append(const Pose& pose) {
    Rotations rotation;
    for (const auto turn : pose.rotations.colwise()) rotation.push_back(QuaternionFromExp(turn));
    Append(pose.root_position, std::move(rotation));
  }
  /// Extrapolates by a pose that repeats the last step.
  void GoOn() {
    const size_t last = positions.size() - 1;
    Rotations rotation = rotations[last];
    for (size_t joint = 0; joint < rotation.size(); ++joint)
      rotation[joint] = rotation[joint] * rotations[last - 1][joint].conjugate() * rotation[joint];
    Append(2 * positions[last] - positions[last - 1], std::move(rotation));
  }
  Eigen::Vector3d Between(size_t from, size_t to, size_t joint) const {
    return ExpFromQuaternion(rotations[from][joint].conjugate() * rotations[to][joint]);
  }

  std::vector<Eigen::Vector3d> positions;
  std::vector<Rotations> rotations;
  std::vector<std::vector<Eigen::Vector3d>> steps;  // between poses, by joint
};

}  // namespace

double HitTime(double u, double hit) { return u + (hit - 1) * u * u * (u - 1); }

void Retime(const PlanContext& context, int first, std::span<const double> times,
            std::vector<Pose>* plan) {
  const auto& history = context.history;
  // Two poses in front, and an extrapolated one at the end.
  Curve curve;
  curve.Append(history[history.size() > 1 ? history.size() - 2 : 0]);
  curve.Append(history.back());
  for (const Pose& pose : *plan) curve.Append(pose);
  curve.GoOn();
  const auto frames = static_cast<int>(plan->size());
  const Pose* last = first > 0 ? &(*plan)[static_cast<size_t>(first) - 1] : &history.back();
  for (int frame = first; frame < frames; ++frame) {
    const double time = std::clamp(times[static_cast<size_t>(frame - first)], -1.0, frames - 1.0);
    const int from = std::min(static_cast<int>(std::floor(time)), frames - 2);
    const std::array<double, 4> weights = CubicWeights(time - from);
    const auto at = static_cast<size_t>(from + 2);
    Pose& pose = (*plan)[static_cast<size_t>(frame)];
    pose.root_position.setZero();
    for (size_t i = 0; i < 4; ++i) pose.root_position += weights[i] * curve.positions[at - 1 + i];
    // A path fixes places in time, so nothing may change its time.
    const Eigen::Vector3d& planned = curve.positions[static_cast<size_t>(frame) + 2];
    if (context.has_path) {
      pose.root_position.x() = planned.x();
      pose.root_position.z() = planned.z();
    }
    if (context.has_heights) pose.root_position.y() = planned.y();
    for (size_t joint = 0; joint < curve.rotations[at].size(); ++joint) {
      // Works in the tangent space of the pose before, from which the previous step leads back.
      const Eigen::Vector3d turn = -weights[0] * curve.steps[at - 1][joint] +
                                   weights[2] * curve.steps[at][joint] +
                                   weights[3] * curve.Between(at, at + 2, joint);
      pose.rotations.col(static_cast<Eigen::Index>(joint)) =
          ExpFromQuaternion(curve.rotations[at][joint] * QuaternionFromExp(turn));
    }
    MakeContinuous(pose, *last);
    last = &pose;
  }
}

void HitKey(const PlanContext& context, double hit, std::vector<Pose>* plan) {
  if (hit == 1) return;
  const auto frames = static_cast<int>(plan->size());
  const int window = std::min(frames, static_cast<int>(std::lround(kHitSeconds * context.fps)));
  const int first = frames - window;
  std::vector<double> times;
  for (int frame = 1; frame <= window; ++frame)
    times.push_back(first - 1 + window * HitTime(double{1} * frame / window, hit));
  Retime(context, first, times, plan);
}

}  // namespace choreo
