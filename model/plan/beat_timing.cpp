#include "model/plan/beat_timing.h"

#include <algorithm>
#include <cmath>

#include "model/plan/plan_stages.h"
#include "model/plan/retime.h"

namespace choreo {

// How much of an accent beats have that are so many frames apart.
double BeatTiming::Share(double period) const {
  return period > kPauseSeconds * fps ? 0 : std::min(1.0, period / (options.fastest * fps));
}

// The shift of time at t, of which Time takes away what the ends have.
double BeatTiming::Shift(double t) const {
  const auto after = std::ranges::upper_bound(beats, t);
  if (after == beats.begin() || after == beats.end()) return 0;
  const double before = *(after - 1), period = *after - before;
  return options.accent * Share(period) * period / (2 * M_PI) *
         std::sin(2 * M_PI * (t - before) / period);
}

// What a key on a beat adds to that within a beat before it (`step` -1) or behind it (1).
double BeatTiming::KeyShift(double key, int step, double t) const {
  const auto beat =
      std::ranges::min_element(beats, {}, [key](double at) { return std::abs(at - key); });
  if (beat == beats.end() || std::abs(*beat - key) >= options.on_beat * fps) return 0;
  if (beat == (step < 0 ? beats.begin() : beats.end() - 1)) return 0;
  const double period = std::abs(*(beat + step) - *beat), away = t - key;
  if (std::abs(away) >= period) return 0;
  return options.key_accent * Share(period) * (1 - std::abs(away) / period) * period / (2 * M_PI) *
         std::sin(2 * M_PI * away / period);
}

double BeatTiming::Time(double t) const {
  const double last = frames - 1, share = (t + 1) / frames;
  double shift = Shift(t) - (1 - share) * Shift(-1) - share * Shift(last);
  const double room = (frames - options.no_key_accent * fps) /
                      (options.whole_key_accent * fps - options.no_key_accent * fps);
  if (keyed && room > 0)
    shift += std::min(room, 1.0) * (KeyShift(-1, 1, t) + KeyShift(last, -1, t));
  return t + std::min(1.0, frames / (options.whole_accent * fps)) * shift;
}

void TimeToBeats(const PlanContext& context, std::vector<Pose>* plan) {
  if (context.beats.empty() || context.has_path) return;
  const BeatTiming timing{context.beats, static_cast<int>(plan->size()), context.keyed, context.fps,
                          context.options};
  std::vector<double> times(plan->size());
  for (int frame = 0; frame < timing.frames; ++frame)
    times[static_cast<size_t>(frame)] = timing.Time(frame);
  *plan = Retime(context.history, *plan, times);
}

}  // namespace choreo
