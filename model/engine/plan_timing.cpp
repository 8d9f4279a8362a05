#include "model/engine/plan_timing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kAccent = 0.25;     // A: the share of its speed that a dancer gains on a beat
constexpr double kWholeAccent = 30;  // frames: shorter transitions, which keys rule, have less
constexpr double kFastest = 10;      // frames between beats; faster ones are accented less
constexpr double kSlowest = 45;      // frames between beats; beyond, the music pauses

// The shift of time at t, of which PlanTime takes away what the ends have.
double Shift(std::span<const double> beats, double t) {
  const auto after = std::ranges::upper_bound(beats, t);
  if (after == beats.begin() || after == beats.end()) return 0;
  const double before = *(after - 1), period = *after - before;
  if (period > kSlowest) return 0;
  const double accent = kAccent * std::min(1.0, period / kFastest);
  return accent * period / (2 * M_PI) * std::sin(2 * M_PI * (t - before) / period);
}

// Catmull-Rom weights at `u` in [0, 1] between the second and the third of four values.
std::array<double, 4> CubicWeights(double u) {
  const double u2 = u * u, u3 = u2 * u;
  return {0.5 * (-u3 + 2 * u2 - u), 0.5 * (3 * u3 - 5 * u2 + 2), 0.5 * (-3 * u3 + 4 * u2 + u),
          0.5 * (u3 - u2)};
}

// The pose as far behind `b` as `a` is before it.
Pose OneFurther(const Pose& a, const Pose& b) {
  Pose further = b;
  further.root_position += b.root_position - a.root_position;
  for (Eigen::Index joint = 0; joint < b.rotations.cols(); ++joint) {
    further.rotations.col(joint) = RotationCompose(
        b.rotations.col(joint), RotationDifference(a.rotations.col(joint), b.rotations.col(joint)));
  }
  return further;
}

}  // namespace

double PlanTime(std::span<const double> beats, int frames, double t) {
  const double last = frames - 1, share = (t + 1) / frames;
  const double shift =
      Shift(beats, t) - (1 - share) * Shift(beats, -1) - share * Shift(beats, last);
  return t + std::min(1.0, frames / kWholeAccent) * shift;
}

std::vector<Pose> TimeToBeats(std::span<const Pose> history, const std::vector<Pose>& plan,
                              std::span<const double> beats) {
  const auto frames = static_cast<int>(plan.size());
  // Two poses in front, and one behind that goes on as the last two go.
  std::vector<Pose> curve = {history[history.size() > 1 ? history.size() - 2 : 0], history.back()};
  curve.insert(curve.end(), plan.begin(), plan.end());
  curve.push_back(OneFurther(curve[curve.size() - 2], curve.back()));
  const auto at = [&](int frame) -> const Pose& { return curve[static_cast<size_t>(frame + 2)]; };
  std::vector<Pose> timed(plan.size());
  const Pose* last = &history.back();
  for (int frame = 0; frame < frames; ++frame) {
    const double time = std::clamp(PlanTime(beats, frames, frame), -1.0, frames - 1.0);
    const int from = std::min(static_cast<int>(std::floor(time)), frames - 2);
    const std::array<double, 4> weights = CubicWeights(time - from);
    const Pose& origin = at(from);
    Pose& pose = timed[static_cast<size_t>(frame)];
    pose.root_position.setZero();
    Eigen::Matrix3Xd turn = Eigen::Matrix3Xd::Zero(3, origin.rotations.cols());
    for (int i = 0; i < 4; ++i) {
      const Pose& neighbour = at(from - 1 + i);
      const double weight = weights[static_cast<size_t>(i)];
      pose.root_position += weight * neighbour.root_position;
      for (Eigen::Index joint = 0; joint < turn.cols(); ++joint)
        turn.col(joint) += weight * RotationDifference(origin.rotations.col(joint),
                                                       neighbour.rotations.col(joint));
    }
    pose.rotations.resize(3, turn.cols());
    for (Eigen::Index joint = 0; joint < turn.cols(); ++joint) {
      pose.rotations.col(joint) =
          NearestBranch(RotationCompose(origin.rotations.col(joint), turn.col(joint)),
                        last->rotations.col(joint));
    }
    last = &pose;
  }
  return timed;
}

}  // namespace choreo
