#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "model/motion/rotation.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

// The share of the accent that beats at this distance (frames) get.
double Share(const PlanContext& context, double period) {
  return period > kPauseSeconds * context.fps
             ? 0
             : std::min(1.0, period / (context.options.fastest * context.fps));
}

// The shift of time at t, before BeatTime removes its values at the ends.
double Shift(const PlanContext& context, double t) {
  const auto after = std::ranges::upper_bound(context.beats, t);
  if (after == context.beats.begin() || after == context.beats.end()) return 0;
  const double before = *(after - 1), period = *after - before;
  return context.options.accent * Share(context, period) * period / (2 * M_PI) *
         std::sin(2 * M_PI * (t - before) / period);
}

// What a key on a beat adds within a beat before it (`step` -1) or after it (1).
double KeyShift(const PlanContext& context, double key, int step, double t) {
  const auto& beats = context.beats;
  const auto beat =
      std::ranges::min_element(beats, {}, [key](double at) { return std::abs(at - key); });
  if (beat == beats.end() || std::abs(*beat - key) >= context.options.on_beat * context.fps)
    return 0;
  if (beat == (step < 0 ? beats.begin() : beats.end() - 1)) return 0;
  const double period = std::abs(*(beat + step) - *beat), away = t - key;
  if (std::abs(away) >= period) return 0;
  return context.options.key_accent * Share(context, period) * (1 - std::abs(away) / period) *
         period / (2 * M_PI) * std::sin(2 * M_PI * away / period);
}

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

double BeatTime(const PlanContext& context, int frames, double t) {
  const PlanOptions& options = context.options;
  const double last = frames - 1, share = (t + 1) / frames;
  double shift =
      Shift(context, t) - (1 - share) * Shift(context, -1) - share * Shift(context, last);
  const double room =
      (frames - options.no_key_accent * context.fps) /
      (options.whole_key_accent * context.fps - options.no_key_accent * context.fps);
  if (context.keyed && room > 0)
    shift += std::min(room, 1.0) * (KeyShift(context, -1, 1, t) + KeyShift(context, last, -1, t));
  return t + std::min(1.0, frames / (options.whole_accent * context.fps)) * shift;
}

double HitTime(double u, double hit) { return u + (hit - 1) * u * u * (u - 1); }

namespace {

// Gives frames from `first` on the poses of other times. A cubic between poses (Catmull-Rom,
// rotations in the tangent space of the pose before) keeps smooth motion smooth.
void Retime(const PlanContext& context, int first, const std::function<double(int)>& time_of,
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
    const double time = std::clamp(time_of(frame), -1.0, frames - 1.0);
    const int from = std::min(static_cast<int>(std::floor(time)), frames - 2);
    const std::array<double, 4> weights = CubicWeights(time - from);
    const auto at = static_cast<size_t>(from + 2);
    Pose& pose = (*plan)[static_cast<size_t>(frame)];
    pose.root_position.setZero();
    for (size_t i = 0; i < 4; ++i) pose.root_position += weights[i] * curve.positions[at - 1 + i];
    // A path fixes where to be when; nothing must bend its time.
    const Eigen::Vector3d& planned = curve.positions[static_cast<size_t>(frame) + 2];
    if (context.has_path) {
      pose.root_position.x() = planned.x();
      pose.root_position.z() = planned.z();
    }
    if (context.has_heights) pose.root_position.y() = planned.y();
    for (size_t joint = 0; joint < curve.rotations[at].size(); ++joint) {
      // In the tangent space of the pose before, from which the previous step leads back.
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

}  // namespace

void TimeToBeats(const PlanContext& context, std::vector<Pose>* plan) {
  if (context.beats.empty()) return;
  const auto frames = static_cast<int>(plan->size());
  Retime(
      context, 0, [&](int frame) { return BeatTime(context, frames, frame); }, plan);
}

void HitKey(const PlanContext& context, double hit, std::vector<Pose>* plan) {
  if (hit == 1) return;
  const auto frames = static_cast<int>(plan->size());
  const int window = std::min(frames, static_cast<int>(std::lround(kHitSeconds * context.fps)));
  const int first = frames - window;
  const auto time = [&](int frame) {
    return first - 1 + window * HitTime(double{1} * (frame - first + 1) / window, hit);
  };
  Retime(context, first, time, plan);
}

}  // namespace choreo
