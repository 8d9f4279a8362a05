#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "model/core/running/each_cpu.h"
#include "model/motion/kinematics/kinematic_beats.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/body_limits.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

// The pace of time is 1 + accent * slope / kSteepest. Slopes are whole numbers and change by one a
// frame, so that time is smooth. The offset from even time is a sum of slopes.
constexpr int kSteepest = 4, kSlopes = 2 * kSteepest + 1;
constexpr int kFarthest = 48;  // offset searched; reached in 12 frames at the steepest slope
constexpr int kOffsets = 2 * kFarthest + 1;
constexpr float kUnreached = -std::numeric_limits<float>::infinity();

// Neighbouring offsets of one slope follow each other.
size_t StateOf(int offset, int slope) {
  return static_cast<size_t>((slope + kSteepest) * kOffsets + offset + kFarthest);
}

// A wave that is 1 on a beat and -1 halfway between two, and smaller for fast beats. 0 before the
// first beat, after the last, and where the music pauses.
double BeatWave(const PlanContext& context, double t) {
  const auto after = std::ranges::upper_bound(context.beats, t);
  if (after == context.beats.begin() || after == context.beats.end()) return 0;
  const double before = *(after - 1), period = *after - before;
  if (period > kPauseSeconds * context.fps) return 0;
  return std::min(1.0, period / (context.options.fastest * context.fps)) *
         std::cos(2 * M_PI * (t - before) / period);
}

// How a plan reaches each of its frames.
struct Pace {
  std::vector<double> speeds;  // the mean of all joints, smoothed as kinematic beats are
  std::vector<double> most;    // the fastest pace of time, at least 1, that human bodies allow
};

Pace PaceOf(const PlanContext& context, std::span<const Pose> plan) {
  Pace pace;
  std::vector<float> speeds;
  Eigen::Matrix3Xd before = JointPositions(context.skeleton, context.history.back());
  for (const Pose& pose : plan) {
    const Eigen::Matrix3Xd now = JointPositions(context.skeleton, pose);
    const Eigen::RowVectorXd steps = (now - before).colwise().norm();
    speeds.push_back(static_cast<float>(steps.mean()));
    pace.most.push_back(std::max(1.0, 1 / SpeedExcess(steps * context.fps)));
    before = now;
  }
  pace.speeds = SmoothSpeeds(speeds, context.fps);
  return pace;
}

// Neighbouring offsets that are reached at one slope.
struct Reached {
  const float* best;  // for the offsets from which this slope leads to these, at this slope
  const double *worth, *fastest;
  int count, slope;
  double pace;
};

CHOREO_EACH_CPU void Reach(const Reached& at, float* __restrict next,
                           signed char* __restrict before) {
  const auto slope = static_cast<signed char>(at.slope);
  // Slopes change by at most one, within the range of slopes.
  const float* below = at.slope > -kSteepest ? at.best - kOffsets : at.best;
  const float* above = at.slope < kSteepest ? at.best + kOffsets : at.best;
  for (int i = 0; i < at.count; ++i) {
    const float slower = below[i], faster = above[i];
    float most = at.best[i];
    signed char from = slope;
    from = slower > most ? static_cast<signed char>(slope - 1) : from;
    most = slower > most ? slower : most;
    from = faster > most ? static_cast<signed char>(slope + 1) : from;
    most = faster > most ? faster : most;
    const bool is_possible = at.slope <= 0 || !(at.pace > at.fastest[i]);
    next[i] = is_possible ? most + static_cast<float>(at.worth[i] * at.pace) : kUnreached;
    before[i] = from;
  }
}

}  // namespace

std::vector<double> TimesOnBeats(const PlanContext& context, std::span<const double> speeds,
                                 std::span<const double> paces) {
  const auto frames = static_cast<int>(speeds.size());
  const double unit = context.options.accent / kSteepest *
                      std::min(1.0, frames / (context.options.whole_accent * context.fps));
  const auto speed_at = [&](double time) {
    const auto frame = static_cast<size_t>(time);
    return std::lerp(speeds[frame], speeds[std::min(frame + 1, speeds.size() - 1)],
                     time - static_cast<double>(frame));
  };
  // Dynamic programming: the best sum of wave times speed for each state of a frame, and the slope
  // before it.
  std::vector<float> best(size_t{kOffsets} * kSlopes, kUnreached), next;
  std::vector<signed char> slope_before(best.size() * speeds.size());
  best[StateOf(0, 0)] = 0;
  std::array<double, kOffsets> worth, fastest;
  for (int t = 0; t < frames; ++t) {
    next.assign(best.size(), kUnreached);
    signed char* const before = &slope_before[best.size() * static_cast<size_t>(t)];
    const double wave = BeatWave(context, t);
    // Offsets that can be reached and left again, and whose time is within the plan.
    const auto is_in_plan = [&](int offset) {
      const double time = t + unit * offset;
      return time >= 0 && time <= frames - 1;
    };
    int last = std::min(kFarthest, kSteepest * std::min(t + 1, frames - 1 - t)), first = -last;
    while (!is_in_plan(first)) ++first;
    while (!is_in_plan(last)) --last;
    for (int offset = first; offset <= last; ++offset) {
      const double time = t + unit * offset;
      const auto frame = static_cast<size_t>(time), at = static_cast<size_t>(offset + kFarthest);
      worth[at] = wave * speed_at(time);
      fastest[at] = paces.empty()
                        ? std::numeric_limits<double>::infinity()
                        : std::min(paces[frame], paces[std::min(frame + 1, paces.size() - 1)]);
    }
    for (int slope = -kSteepest; slope <= kSteepest; ++slope) {
      const int from = std::max(first, slope - kFarthest), to = std::min(last, slope + kFarthest);
      if (from > to) continue;
      Reach({.best = &best[StateOf(from - slope, slope)],
             .worth = &worth[static_cast<size_t>(from + kFarthest)],
             .fastest = &fastest[static_cast<size_t>(from + kFarthest)],
             .count = to - from + 1,
             .slope = slope,
             .pace = 1 + unit * slope},
            &next[StateOf(from, slope)], &before[StateOf(from, slope)]);
    }
    best.swap(next);
  }
  int slope = 0, offset = 0;
  for (int other = -kSteepest; other <= kSteepest; ++other)
    if (best[StateOf(0, other)] > best[StateOf(0, slope)]) slope = other;
  std::vector<double> times(speeds.size());
  for (int t = frames - 1; t >= 0; --t) {
    times[static_cast<size_t>(t)] = t + unit * offset;
    const size_t state = best.size() * static_cast<size_t>(t) + StateOf(offset, slope);
    offset -= slope;
    slope = slope_before[state];
  }
  return times;
}

void TimeToBeats(const PlanContext& context, std::vector<Pose>* plan) {
  if (context.beats.empty()) return;
  const Pace pace = PaceOf(context, *plan);
  const std::vector<double> times = TimesOnBeats(context, pace.speeds, pace.most);
  Retime(context, 0, times, plan);
}

}  // namespace choreo
