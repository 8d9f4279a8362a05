#include "model/engine/plan_pace.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "model/engine/retime.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

constexpr double kFastest =
    1.6;  // m/s, the mean of all joints; one real frame in 10 to 30 is faster
constexpr double kOverMean = 1.3;  // times the way's own mean
constexpr double kEnd = 6;         // frames over which an end's pace gives way

// How long each step takes, in frames, if what is not too fast takes `share` of one; and all.
double Durations(std::span<const double> steps, double longest, double share,
                 std::vector<double>* durations) {
  durations->clear();
  for (size_t i = 0; i < steps.size(); ++i) {
    const auto to_end = static_cast<double>(std::min(i, steps.size() - 1 - i));
    const double free = 1 - (1 - share) * std::min(1.0, to_end / kEnd);
    durations->push_back(std::max(free, steps[i] / longest));
  }
  return std::accumulate(durations->begin(), durations->end(), 0.0);
}

}  // namespace

std::vector<double> EvenTimes(std::span<const double> steps, double longest) {
  std::vector<double> times(steps.size());
  std::iota(times.begin(), times.end(), 0.0);
  if (steps.empty()) return times;
  const auto frames = static_cast<double>(steps.size());
  const double mean = std::accumulate(steps.begin(), steps.end(), 0.0) / frames;
  longest = std::max(longest, kOverMean * mean);
  if (*std::ranges::max_element(steps) <= longest) return times;

  std::vector<double> durations;
  double low = 0, high = 1;
  for (int halving = 0; halving < 40; ++halving) {
    const double share = (low + high) / 2;
    (Durations(steps, longest, share, &durations) > frames ? high : low) = share;
  }
  // Not 1 where the ends leave too little for the rest.
  const double stretch = frames / Durations(steps, longest, low, &durations);
  double clock = -1;  // when the plan leaves its pose i - 1
  size_t frame = 0;
  for (size_t i = 0; i < steps.size(); ++i) {
    const double duration = stretch * durations[i];
    for (; frame + 1 < times.size() && static_cast<double>(frame) < clock + duration; ++frame)
      times[frame] = static_cast<double>(i) - 1 + (static_cast<double>(frame) - clock) / duration;
    clock += duration;
  }
  return times;  // the last frame's is the last pose
}

std::vector<Pose> EvenPace(const Skeleton& skeleton, std::span<const Pose> history,
                           std::vector<Pose> plan, double fps) {
  std::vector<double> steps;
  JointPlacement before = ForwardKinematics(skeleton, history.front()), now = before;
  const auto go = [&](std::span<const Pose> poses) {
    for (const Pose& pose : poses) {
      ForwardKinematics(skeleton, pose, now);
      steps.push_back((now.positions - before.positions).colwise().norm().mean());
      std::swap(before, now);
    }
  };
  go(history);
  const double longest = std::max(kFastest / fps, *std::ranges::max_element(steps));
  steps.clear();
  go(plan);
  if (std::ranges::all_of(steps, [longest](double step) { return step <= longest; })) return plan;
  return Retime(history, plan, EvenTimes(steps, longest));
}

}  // namespace choreo
