#include "model/audio/beats/half_beats.h"

#include <algorithm>
#include <limits>

#include "model/audio/signal/format.h"

namespace choreo {
namespace {

constexpr int64_t kBehind = 3;       // frames after a beat in which it may sound
constexpr double kClearly = 0.1;     // of all variance; less is chance
constexpr double kLouderBass = 2;    // between beats than on them
constexpr double kAsMuchBass = 0.7;  // on kicks, beside snares that kicks may double
constexpr double kNearlyAll = 0.9;   // beats; a bass guitar's rhythm varies
constexpr float kHeard_dB = 2;       // rise of a band; less can't be heard
constexpr size_t kAround = 4;        // beats that tell how strong a part's onsets are
constexpr double kWeak = 0.5;        // beside the strongest part's

struct Mean {
  double sum = 0, count = 0;

  void Add(double value) {
    sum += value;
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : 0; }
};

/// How strong a band's onsets are before and after each beat, whichever is weaker, beside where
/// they are strongest.
std::vector<double> StrengthOf(size_t band, std::span<const Onset> onsets,
                               std::span<const BarPointer::Step> path) {
  std::vector<double> sums{0}, strength;
  for (const Onset& onset : onsets) sums.push_back(sums.back() + onset.rise[band]);
  const auto mean = [&](size_t first, size_t last) {
    const auto from = static_cast<size_t>(path[first].frame);
    const auto to = static_cast<size_t>(path[last].frame);
    return (sums[to] - sums[from]) / static_cast<double>(to - from);
  };
  const size_t last = path.size() - 1;
  for (size_t i = 0; i <= last && last > 0; ++i) {
    const double before = i == 0 ? mean(0, 1) : mean(i - std::min(i, kAround), i);
    const double after = i == last ? mean(last - 1, last) : mean(i, std::min(i + kAround, last));
    strength.push_back(std::min(before, after));
  }
  const double most = strength.empty() ? 0 : *std::ranges::max_element(strength);
  strength.resize(path.size());
  for (double& value : strength) value = most > 0 ? value / most : 1;
  return strength;
}

}  // namespace

std::vector<bool> AreStrong(std::span<const Onset> onsets, std::span<const BarPointer::Step> path) {
  std::vector<double> least(path.size(), 1);
  for (size_t band = 0; band < Onset::kBands; ++band) {
    const std::vector<double> strength = StrengthOf(band, onsets, path);
    for (size_t i = 0; i < least.size(); ++i) least[i] = std::min(least[i], strength[i]);
  }
  const double most = least.empty() ? 0 : *std::ranges::max_element(least);
  std::vector<bool> are;
  for (const double value : least) are.push_back(value >= kWeak * most);
  return are;
}

HalfBeats::HalfBeats(std::span<const Onset> onsets, std::span<const BarPointer::Step> path) {
  std::vector<std::array<float, Onset::kBands>> even;
  // Uncapped: a cap would make all drums alike, and only drums distinguish the beats of a bar.
  EvenOnsets evened(std::numeric_limits<float>::infinity());
  evened.Settle(onsets);
  for (const Onset& onset : onsets) even.push_back(evened.Even(onset));
  const std::vector<bool> strong = AreStrong(onsets, path);
  for (size_t i = 0; i < path.size(); ++i) {
    const BarPointer::Step& step = path[i];
    if (step.frame + step.period / 2 + kBehind > std::ssize(even))
      break;  // its second half is still to come
    counts_.insert(counts_.end(), 2, strong[i]);
    if (strong[i]) periods_.push_back(step.period);
    for (const int64_t frame : {step.frame, step.frame + step.period / 2}) {
      auto& half = halves_.emplace_back();
      half.fill(0);
      auto& is_heard = is_heard_.emplace_back();
      is_heard.fill(false);
      place_.push_back(static_cast<size_t>(step.in_bar) % 2 * 2 + (frame == step.frame ? 0 : 1));
      const int64_t to = std::min<int64_t>(std::ssize(even), frame + kBehind);
      for (int64_t f = std::max<int64_t>(0, frame - 1); f < to; ++f) {
        for (size_t band = 0; band < half.size(); ++band) {
          half[band] = std::max(half[band], double{even[static_cast<size_t>(f)][band]});
          is_heard[band] = is_heard[band] || onsets[static_cast<size_t>(f)].rise[band] >= kHeard_dB;
        }
      }
    }
  }
}

int HalfBeats::Period() const { return periods_.empty() ? 0 : periods_[periods_.size() / 2]; }

bool HalfBeats::AreAlike(double share) const {
  bool any = false;
  for (size_t band = 0; band < Onset::kBands; ++band) {
    std::array<double, 2> sums{};
    for (size_t i = 0; i < halves_.size(); ++i)
      if (counts_[i]) sums[i % 2] += std::min<double>(halves_[i][band], EvenOnsets::kLoudest);
    const auto [weaker, stronger] = std::minmax(sums[0], sums[1]);
    if (weaker < share * stronger) return false;
    any = any || stronger > 0;
  }
  return any;
}

bool HalfBeats::AreAlikeButForAccent(double share) const {
  std::array<bool, kPlaces> can_be{};
  can_be.fill(MeterOf() == Meter::kFour);
  bool any = false;
  for (size_t band = 0; band < Onset::kBands; ++band) {
    std::array<Mean, kPlaces> places, heard;
    for (size_t i = 0; i < halves_.size(); ++i) {
      if (!counts_[i]) continue;
      const double is_heard = is_heard_[i][band] ? 1 : 0;
      places[place_[i]].Add(is_heard * std::min<double>(halves_[i][band], EvenOnsets::kLoudest));
      heard[place_[i]].Add(is_heard);
    }
    // A band that is heard now and then, such as clicks of chords, has no part in the rhythm.
    if (std::ranges::max(heard, {}, &Mean::mean).mean() < kNearlyAll) continue;
    any = true;
    for (size_t accent = 0; accent < kPlaces; ++accent) {
      double weakest = EvenOnsets::kLoudest, strongest = 0;
      for (size_t place = 0; place < kPlaces; ++place) {
        if (place == accent) continue;
        weakest = std::min(weakest, places[place].mean());
        strongest = std::max(strongest, places[place].mean());
      }
      const bool has_bass = band > 0 || places[accent].mean() >= share * strongest;
      can_be[accent] = can_be[accent] && has_bass && weakest >= share * strongest;
    }
  }
  return any && std::ranges::count(can_be, true) > 0;
}

bool HalfBeats::BassIsBetween() const {
  std::array<double, 2> bass{};
  double louder = 0, beats = 0;
  for (size_t i = 0; i + 1 < halves_.size(); i += 2) {
    if (!counts_[i]) continue;
    const double on = halves_[i][0], between = halves_[i + 1][0];
    bass[0] += on;
    bass[1] += between;
    louder += between > on ? 1 : 0;
    ++beats;
  }
  return bass[1] > kLouderBass * bass[0] && louder > kNearlyAll * beats;
}

int HalfBeats::SnareHalf() const {
  std::array<double, 2> bass{}, brighter{};
  double beats = 0;
  for (size_t i = 0; i + 1 < halves_.size(); i += 2) {
    if (!counts_[i]) continue;
    ++beats;
    for (const size_t half : {0, 1}) {
      const Bands &own = halves_[i + half], &other = halves_[i + 1 - half];
      bass[half] += own[0];
      brighter[half] += own[1] > other[1] && own[2] > other[2] ? 1 : 0;
    }
  }
  for (const size_t half : {0, 1}) {
    if (brighter[half] > kNearlyAll * beats && bass[1 - half] > kAsMuchBass * bass[half])
      return static_cast<int>(half);
  }
  return -1;
}

double HalfBeats::Correlation(size_t lag) const {
  Bands means{};
  double counted = 0;
  for (size_t i = 0; i < halves_.size(); ++i) {
    if (!counts_[i]) continue;
    ++counted;
    for (size_t band = 0; band < Onset::kBands; ++band) means[band] += halves_[i][band];
  }
  double sum = 0, pairs = 0;
  for (size_t i = lag; i < halves_.size(); ++i) {
    if (!counts_[i] || !counts_[i - lag]) continue;
    ++pairs;
    for (size_t band = 0; band < Onset::kBands; ++band) {
      const double mean = means[band] / counted;
      sum += (halves_[i][band] - mean) * (halves_[i - lag][band] - mean);
    }
  }
  return pairs > 0 ? sum / pairs : 0;
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

std::vector<BarPointer::Step> Doubled(const std::vector<BarPointer::Step>& path, int slow,
                                      int half) {
  std::vector<BarPointer::Step> doubled;
  const auto add = [&](const BarPointer::Step& step, int64_t frame, int period) {
    const size_t since = doubled.size() + static_cast<size_t>(4 - half);
    doubled.push_back({frame, period, static_cast<int>(since % 4), step.pattern, 4});
  };
  for (const BarPointer::Step& step : path) {
    const bool is_slow = step.period >= slow;
    const int period = is_slow ? step.period / 2 : step.period;
    add(step, step.frame, period);
    if (is_slow) add(step, step.frame + period, period);
  }
  return doubled;
}

}  // namespace choreo
