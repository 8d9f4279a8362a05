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

constexpr double kKeyAccent = 0.75;  // gained besides on a key that stands on a beat
constexpr double kOnBeat = 2.5;      // frames between key and beat
constexpr double kNoKeyAccent = 30, kWholeKeyAccent = 60;  // frames of a transition

// How much of an accent beats have that are so many frames apart.
double Share(double period) { return period > kSlowest ? 0 : std::min(1.0, period / kFastest); }

// The shift of time at t, of which PlanTime takes away what the ends have.
double Shift(std::span<const double> beats, double t) {
  const auto after = std::ranges::upper_bound(beats, t);
  if (after == beats.begin() || after == beats.end()) return 0;
  const double before = *(after - 1), period = *after - before;
  return kAccent * Share(period) * period / (2 * M_PI) * std::sin(2 * M_PI * (t - before) / period);
}

// What a key on a beat adds to that within a beat before it (`step` -1) or behind it (1).
double KeyShift(std::span<const double> beats, double key, int step, double t) {
  const auto beat =
      std::ranges::min_element(beats, {}, [key](double at) { return std::abs(at - key); });
  if (beat == beats.end() || std::abs(*beat - key) >= kOnBeat) return 0;
  if (beat == (step < 0 ? beats.begin() : beats.end() - 1)) return 0;
  const double period = std::abs(*(beat + step) - *beat), away = t - key;
  if (std::abs(away) >= period) return 0;
  return kKeyAccent * Share(period) * (1 - std::abs(away) / period) * period / (2 * M_PI) *
         std::sin(2 * M_PI * away / period);
}

}  // namespace

double PlanTime(std::span<const double> beats, int frames, bool keyed, double t) {
  const double last = frames - 1, share = (t + 1) / frames;
  double shift = Shift(beats, t) - (1 - share) * Shift(beats, -1) - share * Shift(beats, last);
  const double room = (frames - kNoKeyAccent) / (kWholeKeyAccent - kNoKeyAccent);
  if (keyed && room > 0)
    shift += std::min(room, 1.0) * (KeyShift(beats, -1, 1, t) + KeyShift(beats, last, -1, t));
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
