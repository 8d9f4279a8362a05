#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "model/motion/body_limits.h"
#include "model/motion/kinematic_beats.h"
#include "model/motion/kinematics.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

// The pace of time is 1 + accent * slope / kSteepest. Slopes are whole numbers and change by one a
// frame, so that time is smooth. The offset from even time is a sum of slopes.
constexpr int kSteepest = 4, kSlopes = 2 * kSteepest + 1;
constexpr int kFarthest = 48;  // offset searched; reached in 12 frames at the steepest slope
constexpr float kUnreached = -std::numeric_limits<float>::infinity();

size_t StateOf(int offset, int slope) {
  return static_cast<size_t>((offset + kFarthest) * kSlopes + slope + kSteepest);
}

// 1 on a beat and -1 halfway between two, smaller for fast beats; 0 before the first, after the
// last and where the music pauses.
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
  std::vector<double> most;    // the fastest pace of time, at least 1, at which bodies can move
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
  std::vector<float> best(StateOf(kFarthest, kSteepest) + 1, kUnreached), next;
  std::vector<signed char> slope_before(best.size() * speeds.size());
  best[StateOf(0, 0)] = 0;
  for (int t = 0; t < frames; ++t) {
    next.assign(best.size(), kUnreached);
    signed char* const before = &slope_before[best.size() * static_cast<size_t>(t)];
    const double wave = BeatWave(context, t);
    // Offsets that can be reached and left again.
    const int farthest = std::min(kFarthest, kSteepest * std::min(t + 1, frames - 1 - t));
    for (int offset = -farthest; offset <= farthest; ++offset) {
      const double time = t + unit * offset;
      if (time < 0 || time > frames - 1) continue;
      const double worth = wave * speed_at(time);
      const auto frame = static_cast<size_t>(time);
      const double fastest =
          paces.empty() ? std::numeric_limits<double>::infinity()
                        : std::min(paces[frame], paces[std::min(frame + 1, paces.size() - 1)]);
      for (int slope = -kSteepest; slope <= kSteepest; ++slope) {
        if (std::abs(offset - slope) > kFarthest) continue;
        if (slope > 0 && 1 + unit * slope > fastest) continue;
        float most = kUnreached;
        for (const int from : {slope, slope - 1, slope + 1}) {
          if (std::abs(from) > kSteepest) continue;
          const float value = best[StateOf(offset - slope, from)];
          if (value <= most) continue;
          most = value;
          before[StateOf(offset, slope)] = static_cast<signed char>(from);
        }
        next[StateOf(offset, slope)] = most + static_cast<float>(worth * (1 + unit * slope));
      }
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
