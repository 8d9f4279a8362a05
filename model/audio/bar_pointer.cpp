#include "model/audio/bar_pointer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/audio/format.h"

namespace choreo {
namespace {

constexpr double kFramesPerMinute = 60 * kOnsetRate;
constexpr double kEvenSeconds = 3;
constexpr double kNothingDb = 0.02;  // mean rise below which a band counts as silent

// An onset counts from a frame before its beat to two after.
constexpr int kFirstFrame = -1, kFrames = 4;
constexpr double kBetween = 0.5;  // mean rise between the places, in every pattern
// Neighbouring frames and bands are correlated, so each counts for a fifth.
constexpr double kWeight = 0.2;
constexpr double kTempoCost = 100;  // Krebs et al. 2015

int PeriodOf(double bpm) { return static_cast<int>(std::lround(kFramesPerMinute / bpm)); }

}  // namespace

std::array<float, Onset::kBands> EvenOnsets::Even(const Onset& onset) {
  static const double kept = std::exp(-1.0 / (kEvenSeconds * kModelSampleRate / kOnsetHop));
  std::array<float, Onset::kBands> even;
  for (size_t band = 0; band < even.size(); ++band) {
    const double rise = onset.rise[band];
    level_[band] = kept * level_[band] + (1 - kept) * rise;
    even[band] = level_[band] > kNothingDb
                     ? std::min(static_cast<float>(rise / level_[band]), loudest_)
                     : -1.0F;
  }
  return even;
}

BarPointer::BarPointer(std::span<const BarPattern> patterns, const Limits& limits)
    : patterns_(patterns.begin(), patterns.end()) {
  for (size_t pattern = 0; pattern < patterns_.size(); ++pattern) AddPart(pattern, limits);
  size_t scores = 0;
  int longest = 0;
  for (Ring& ring : rings_) {
    ring.first_score = static_cast<uint32_t>(scores);
    scores += static_cast<size_t>(ring.period);
    scores_.resize(scores, static_cast<float>(-std::log(ring.period)));
    longest = std::max(longest, ring.period);
  }
  place_scores_.resize(likelihood_.size() / Onset::kBands * kHistory);
  beginning_.resize(place_scores_.size());
  best_.resize(rings_.size());
  from_.resize(rings_.size());
  step_cost_.resize(static_cast<size_t>(longest) + 2);
  stay_cost_.resize(step_cost_.size());
  for (int period = 1; period <= longest; ++period) {
    const auto i = static_cast<size_t>(period);
    step_cost_[i] = static_cast<float>(kTempoCost * std::log((period + 1.0) / period));
    double sum = 0;
    for (int to = std::max(1, period / 2); to <= 2 * period; ++to)
      sum += std::exp(-kTempoCost * std::abs(std::log(double{1} * to / period)));
    stay_cost_[i] = static_cast<float>(std::log(sum));
  }
}

void BarPointer::AddPart(size_t nth, const Limits& limits) {
  const BarPattern& pattern = patterns_[nth];
  const int shortest = PeriodOf(std::min(pattern.fastest_bpm, limits.fastest_bpm));
  const int longest = PeriodOf(std::max(pattern.slowest_bpm, limits.slowest_bpm));
  if (shortest > longest) return;
  parts_.push_back({nth, static_cast<size_t>(pattern.beats), rings_.size(),
                    static_cast<size_t>(longest - shortest + 1),
                    likelihood_.size() / Onset::kBands});
  for (const BarPattern::Bands& bands : pattern.rise) {
    // Log of the exponential density, relative to that between the places.
    for (const double mean : bands)
      likelihood_.push_back(
          {kWeight * std::log(kBetween / mean), kWeight * (1 / kBetween - 1 / mean)});
  }
  for (int period = shortest; period <= longest; ++period) {
    Ring ring{0, period, 0, {}};
    ring.begin.fill(kNowhere);
    for (size_t place = 0; place < pattern.places; ++place) {
      const double at = pattern.place[place];
      // The first one counts of positions too close to distinguish at this tempo.
      const auto is_near = [&](double other) {
        const double apart = std::abs(other - at);
        return period * std::min(apart, 1 - apart) < kFrames + 1;
      };
      if (!std::any_of(pattern.place.begin(), &pattern.place[place], is_near))
        ring.begin[place] = static_cast<int8_t>(std::lround(period * at) + kFirstFrame);
    }
    rings_.insert(rings_.end(), kBeats, ring);
  }
}

void BarPointer::Add(const Onset& onset) {
  for (const Part& part : parts_) {
    Leave(part);
    Arrive(part);
  }
  back_.insert(back_.end(), from_.begin(), from_.end());
  const auto even = even_.Even(onset);
  for (size_t place = 0; place * even.size() < likelihood_.size(); ++place) {
    double sum = 0;
    for (size_t band = 0; band < even.size(); ++band) {
      const auto& [constant, slope] = likelihood_[place * even.size() + band];
      if (even[band] >= 0) sum += constant + slope * even[band];
    }
    place_scores_[At(place, frames_)] = static_cast<float>(sum);
    float& beginning = beginning_[At(place, frames_ - kFrames + 1)];
    beginning = 0;
    for (int i = 0; i < kFrames; ++i) beginning += place_scores_[At(place, frames_ - i)];
  }
  ++frames_;
}

// Sets best_ of each beat to the path that stays at its tempo.
void BarPointer::Leave(const Part& part) {
  for (size_t tempo = 0; tempo < part.tempi; ++tempo) {
    const size_t first = part.first_ring + tempo * kBeats;
    const float stay = stay_cost_[static_cast<size_t>(rings_[first].period)];
    for (size_t beat = 0; beat < part.beats; ++beat) {
      Ring& ring = rings_[first + beat];
      ring.zero = ring.zero == 0 ? ring.period - 1 : ring.zero - 1;
      float score = scores_[ring.first_score + static_cast<size_t>(ring.zero)] - stay;
      const int64_t start = frames_ - ring.period;
      const size_t places = part.first_place + beat * BarPattern::kPlaces;
      for (size_t place = 0; place < ring.begin.size(); ++place) {
        if (ring.begin[place] != kNowhere)
          score += beginning_[At(places + place, start + ring.begin[place])];
      }
      best_[first + (beat + 1) % part.beats] = score;
    }
  }
}

// Changes of tempo. Their cost adds up from period to period, so two passes find the best.
void BarPointer::Arrive(const Part& part) {
  const size_t first = part.first_ring, shortest = static_cast<size_t>(rings_[first].period);
  float* best = &best_[first];
  int* from = &from_[first];
  const auto improve = [&](size_t to, size_t by, float cost) {
    for (size_t beat = 0; beat < kBeats; ++beat) {
      const float other = best[by * kBeats + beat] - cost;
      float& own = best[to * kBeats + beat];
      int& own_from = from[to * kBeats + beat];
      own_from = other > own ? from[by * kBeats + beat] : own_from;
      own = other > own ? other : own;
    }
  };
  for (size_t tempo = 0; tempo < part.tempi; ++tempo)
    std::fill_n(from + tempo * kBeats, kBeats, static_cast<int>(tempo));
  for (size_t tempo = 1; tempo < part.tempi; ++tempo)
    improve(tempo, tempo - 1, step_cost_[shortest + tempo - 1]);
  for (size_t tempo = part.tempi - 1; tempo-- > 0;)
    improve(tempo, tempo + 1, step_cost_[shortest + tempo]);
  for (size_t r = first; r < first + part.tempi * kBeats; ++r)
    scores_[rings_[r].first_score + static_cast<size_t>(rings_[r].zero)] = best_[r];
}

float BarPointer::ScoreSince(const Ring& ring, size_t first_place, int64_t start) const {
  float sum = 0;
  for (size_t place = 0; place < ring.begin.size(); ++place) {
    if (ring.begin[place] == kNowhere) continue;
    const int64_t begin = start + ring.begin[place];
    for (int64_t frame = begin; frame < std::min(begin + kFrames, frames_); ++frame)
      sum += place_scores_[At(first_place + place, frame)];
  }
  return sum;
}

size_t BarPointer::BestRing(int* frames_since) const {
  float most = -std::numeric_limits<float>::infinity();
  size_t best = 0;
  for (const Part& part : parts_) {
    for (size_t at = 0; at < part.tempi * kBeats; ++at) {
      if (at % kBeats >= part.beats) continue;
      const Ring& ring = rings_[part.first_ring + at];
      for (int since = 0; since < ring.period; ++since) {
        const auto start = static_cast<size_t>((ring.zero + since) % ring.period);
        const float score = scores_[ring.first_score + start] +
                            ScoreSince(ring, part.first_place + at % kBeats * BarPattern::kPlaces,
                                       frames_ - 1 - since);
        if (score <= most) continue;
        most = score;
        best = part.first_ring + at;
        *frames_since = since;
      }
    }
  }
  return best;
}

const BarPointer::Part& BarPointer::PartOf(size_t ring) const {
  return *std::ranges::find_if(
      parts_, [ring](const Part& part) { return ring < part.first_ring + part.tempi * kBeats; });
}

std::vector<BarPointer::Step> BarPointer::Path() const {
  std::vector<Step> path;
  if (rings_.empty() || frames_ == 0) return path;
  int since = 0;
  size_t ring = BestRing(&since);
  const Part& part = PartOf(ring);
  const auto beats = static_cast<int>(part.beats);
  for (int64_t frame = frames_ - 1 - since; frame >= 0; frame -= rings_[ring].period) {
    const auto beat = static_cast<int>((ring - part.first_ring) % kBeats);
    path.push_back({frame, rings_[ring].period, beat, part.pattern, beats});
    const size_t tempo = back_[static_cast<size_t>(frame) * rings_.size() + ring];
    ring = part.first_ring + tempo * kBeats + static_cast<size_t>((beat + beats - 1) % beats);
  }
  std::ranges::reverse(path);
  return path;
}

}  // namespace choreo
