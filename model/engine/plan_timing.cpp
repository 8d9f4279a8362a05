#include "model/engine/plan_timing.h"

#include <algorithm>
#include <cmath>

#include "model/engine/retime.h"

namespace choreo {
namespace {

constexpr double kAccent = 0.25;     // A: the share of its speed that a dancer gains on a beat
constexpr double kWholeAccent = 30;  // frames: shorter transitions, which keys rule, have less
constexpr double kFastest = 10;      // frames between beats; faster ones are accented less
constexpr double kSlowest = 45;      // frames between beats; beyond, the music pauses

constexpr double kKeyAccent = 0.6;  // the same on a key that stands on a beat
constexpr double kKeyReach = 24;    // frames of which it takes its time
constexpr double kOnBeat = 2.5;     // frames between key and beat
constexpr double kNoKeyAccent = 30, kWholeKeyAccent = 60;  // frames of a transition

// The shift of time at t, of which PlanTime takes away what the ends have.
double Shift(std::span<const double> beats, double t) {
  const auto after = std::ranges::upper_bound(beats, t);
  if (after == beats.begin() || after == beats.end()) return 0;
  const double before = *(after - 1), period = *after - before;
  if (period > kSlowest) return 0;
  const double accent = kAccent * std::min(1.0, period / kFastest);
  return accent * period / (2 * M_PI) * std::sin(2 * M_PI * (t - before) / period);
}

// The shift of time `away` frames before or behind (negative) a key: none at the key nor where its
// reach ends.
double KeyShift(double away) {
  if (std::abs(away) >= kKeyReach) return 0;
  return -kKeyAccent * (1 - std::abs(away) / kKeyReach) * kKeyReach / (2 * M_PI) *
         std::sin(2 * M_PI * away / kKeyReach);
}

bool OnBeat(std::span<const double> beats, double key) {
  return std::ranges::any_of(beats, [key](double beat) { return std::abs(beat - key) < kOnBeat; });
}

}  // namespace

double PlanTime(std::span<const double> beats, int frames, bool keyed, double t) {
  const double last = frames - 1, share = (t + 1) / frames;
  double shift = Shift(beats, t) - (1 - share) * Shift(beats, -1) - share * Shift(beats, last);
  const double room = (frames - kNoKeyAccent) / (kWholeKeyAccent - kNoKeyAccent);
  if (keyed && room > 0) {
    for (const double key : {-1.0, last})
      if (OnBeat(beats, key)) shift += std::min(room, 1.0) * KeyShift(key - t);
  }
  return t + std::min(1.0, frames / kWholeAccent) * shift;
}

std::vector<Pose> TimeToBeats(std::span<const Pose> history, std::span<const Pose> plan,
                              std::span<const double> beats, bool keyed) {
  const auto frames = static_cast<int>(plan.size());
  std::vector<double> times(plan.size());
  for (int frame = 0; frame < frames; ++frame)
    times[static_cast<size_t>(frame)] = PlanTime(beats, frames, keyed, frame);
  return Retime(history, plan, times);
}

}  // namespace choreo
