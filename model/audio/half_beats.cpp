#include "model/audio/half_beats.h"

#include <algorithm>
#include <limits>

#include "model/audio/format.h"

namespace choreo {
namespace {

constexpr int64_t kBehind = 3;      // frames after a beat in which it may sound
constexpr double kClearly = 0.1;    // of all variance; less is chance
constexpr double kLouderBass = 2;   // between beats than on them
constexpr double kNearlyAll = 0.9;  // beats; a bass guitar's rhythm varies

}  // namespace

HalfBeats::HalfBeats(std::span<const Onset> onsets, std::span<const BarPointer::Step> path) {
  std::vector<std::array<float, Onset::kBands>> even;
  // Uncapped: a cap would make all drums alike, and only drums distinguish the beats of a bar.
  EvenOnsets evened(std::numeric_limits<float>::infinity());
  evened.Settle(onsets);
  for (const Onset& onset : onsets) even.push_back(evened.Even(onset));
  for (const BarPointer::Step& step : path) {
    if (step.frame + step.period / 2 + kBehind > std::ssize(even))
      break;  // its second half is still to come
    for (const int64_t frame : {step.frame, step.frame + step.period / 2}) {
      auto& half = halves_.emplace_back();
      half.fill(0);
      const int64_t to = std::min<int64_t>(std::ssize(even), frame + kBehind);
      for (int64_t f = std::max<int64_t>(0, frame - 1); f < to; ++f) {
        for (size_t band = 0; band < half.size(); ++band)
          half[band] = std::max(half[band], double{even[static_cast<size_t>(f)][band]});
      }
    }
  }
}

bool HalfBeats::AreAlike(double share) const {
  bool any = false;
  for (size_t band = 0; band < Onset::kBands; ++band) {
    std::array<double, 2> sums{};
    for (size_t i = 0; i < halves_.size(); ++i)
      sums[i % 2] += std::min<double>(halves_[i][band], EvenOnsets::kLoudest);
    const auto [weaker, stronger] = std::minmax(sums[0], sums[1]);
    if (weaker < share * stronger) return false;
    any = any || stronger > 0;
  }
  return any;
}

bool HalfBeats::BassIsBetween() const {
  std::array<double, 2> bass{};
  double louder = 0, beats = 0;
  for (size_t i = 0; i + 1 < halves_.size(); i += 2) {
    const double on = halves_[i][0], between = halves_[i + 1][0];
    bass[0] += on;
    bass[1] += between;
    louder += between > on ? 1 : 0;
    ++beats;
  }
  return bass[1] > kLouderBass * bass[0] && louder > kNearlyAll * beats;
}

double HalfBeats::Correlation(size_t lag) const {
  if (halves_.size() <= lag) return 0;
  double sum = 0;
  for (size_t band = 0; band < Onset::kBands; ++band) {
    double mean = 0;
    for (const auto& half : halves_) mean += half[band] / static_cast<double>(halves_.size());
    for (size_t i = lag; i < halves_.size(); ++i)
      sum += (halves_[i][band] - mean) * (halves_[i - lag][band] - mean);
  }
  return sum / static_cast<double>(halves_.size() - lag);
}

Meter HalfBeats::MeterOf() const {
  if (Correlation(6) < Correlation(8) + kClearly * Correlation(0)) return Meter::kFour;
  return Correlation(3) > Correlation(2) ? Meter::kSix : Meter::kThree;
}

std::vector<BarPointer::Step> HalfABeatEarly(const std::vector<BarPointer::Step>& path,
                                             int64_t frames) {
  std::vector<BarPointer::Step> early;
  for (BarPointer::Step step : path) {
    step.frame -= step.period / 2;
    if (step.frame >= 0) early.push_back(step);
  }
  if (path.empty() || early.empty()) return early;
  BarPointer::Step last = path.back();
  last.frame += last.period / 2;
  last.in_bar = (last.in_bar + 1) % last.beats;
  if (last.frame < frames) early.push_back(last);
  return early;
}

std::vector<BarPointer::Step> Doubled(const std::vector<BarPointer::Step>& path) {
  std::vector<BarPointer::Step> doubled;
  for (BarPointer::Step step : path) {
    const int64_t frame = step.frame;
    const int period = step.period;
    step.beats = 4;
    step.period = period / 2;
    for (const int half : {0, 1}) {
      step.frame = frame + half * (period / 2);
      step.in_bar = static_cast<int>(doubled.size() % 4);
      doubled.push_back(step);
    }
  }
  return doubled;
}

}  // namespace choreo
