#include "client/live/beat_clock.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace choreo::live {
namespace {

constexpr size_t kBeats = 9;      // used for the period
constexpr double kForgotten = 3;  // seconds without a beat after which there is no period
// A step this many times the median is a gap: earlier beats no longer count.
constexpr double kGap = 1.7;
constexpr double kRounding = 1e-3;  // seconds, for requests at a beat itself

}  // namespace

void BeatClock::Hear(const client::Beat& beat) {
  const std::optional<double> step = Step();
  if (step && beat.time_s - beats_.back().time_s > kGap * *step) beats_.clear();
  beats_.push_back(beat);
  if (beats_.size() > kBeats) beats_.pop_front();
}

std::optional<double> BeatClock::Step() const {
  if (beats_.size() < 2) return std::nullopt;
  std::vector<double> steps;
  for (size_t i = 1; i < beats_.size(); ++i)
    steps.push_back(beats_[i].time_s - beats_[i - 1].time_s);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

std::optional<double> BeatClock::Period(double now) const {
  if (beats_.size() < 3 || now - beats_.back().time_s > kForgotten) return std::nullopt;
  return Step();
}

double BeatClock::AtOrAfter(double seconds, double now) const {
  const std::optional<double> period = Period(now);
  if (!period) return seconds;
  const double last = beats_.back().time_s;
  return last + *period * std::ceil((seconds - last - kRounding) / *period);
}

}  // namespace choreo::live
