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
  size_t states = 0;
  int longest = 0;
  for (size_t p = 0; p < patterns_.size(); ++p) {
    const BarPattern& pattern = patterns_[p];
    const int shortest_period = PeriodOf(std::min(pattern.fastest_bpm, limits.fastest_bpm));
    const int longest_period = PeriodOf(std::max(pattern.slowest_bpm, limits.slowest_bpm));
    if (shortest_period > longest_period) continue;
    longest = std::max(longest, longest_period);
    const size_t first_group = groups_.size();
    const auto count = static_cast<size_t>(longest_period - shortest_period + 1);
    for (int beat = 0; beat < pattern.beats; ++beat) {
      groups_.push_back(
          {p, rings_.size(), count,
           first_group + static_cast<size_t>((beat + pattern.beats - 1) % pattern.beats)});
      for (int period = shortest_period; period <= longest_period; ++period) {
        Ring ring{p, states, beat, period, 0, {}};
        states += static_cast<size_t>(period);
        std::vector<bool> taken(static_cast<size_t>(period));
        for (size_t place = 0; place < pattern.places; ++place) {
          // Of positions too close to distinguish at this tempo, the first one counts.
          const bool is_near = std::any_of(
              pattern.place.begin(), pattern.place.begin() + static_cast<std::ptrdiff_t>(place),
              [&](double other) {
                const double apart = std::abs(other - pattern.place[place]);
                return period * std::min(apart, 1 - apart) < kFrames + 1;
              });
          if (is_near) continue;
          const auto centre = static_cast<int>(std::lround(period * pattern.place[place]));
          for (int i = 0; i < kFrames; ++i) {
            const int frame = centre + kFirstFrame + i;
            const int at = (frame + period) % period;
            if (taken[static_cast<size_t>(at)]) continue;
            taken[static_cast<size_t>(at)] = true;
            const int of = frame < 0 ? (beat + 1) % pattern.beats : beat;
            ring.hits.push_back({at, static_cast<size_t>(of) * BarPattern::kPlaces + place});
          }
        }
        rings_.push_back(std::move(ring));
      }
    }
  }
  states_.resize(states);
  for (const Ring& ring : rings_) {
    std::fill_n(states_.begin() + static_cast<std::ptrdiff_t>(ring.first_state), ring.period,
                static_cast<float>(-std::log(ring.period)));
  }
  for (const BarPattern& pattern : patterns_) {
    auto& terms = likelihood_.emplace_back();
    for (const BarPattern::Bands& bands : pattern.rise) {
      // Log of the exponential density, relative to that between the places.
      for (const double mean : bands)
        terms.push_back({kWeight * std::log(kBetween / mean), kWeight * (1 / kBetween - 1 / mean)});
    }
    place_score_.emplace_back(pattern.rise.size());
  }
  leaving_.resize(rings_.size());
  arriving_.resize(rings_.size());
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

void BarPointer::Add(const Onset& onset) {
  const auto even = even_.Even(onset);
  for (size_t p = 0; p < patterns_.size(); ++p) {
    for (size_t place = 0; place < place_score_[p].size(); ++place) {
      double sum = 0;
      for (size_t band = 0; band < even.size(); ++band) {
        const auto& [constant, slope] = likelihood_[p][place * Onset::kBands + band];
        if (even[band] >= 0) sum += constant + slope * even[band];
      }
      place_score_[p][place] = static_cast<float>(sum);
    }
  }
  for (size_t r = 0; r < rings_.size(); ++r) {
    Ring& ring = rings_[r];
    ring.zero = ring.zero == 0 ? ring.period - 1 : ring.zero - 1;
    leaving_[r] = states_[ring.first_state + static_cast<size_t>(ring.zero)];
  }
  for (const Group& group : groups_) {
    // The cost of a tempo change adds up from period to period, so two passes find the best.
    const size_t before = groups_[group.before].first_ring, first = group.first_ring;
    float* best = &arriving_[first];
    uint8_t* from = &from_[first];
    const auto shortest = static_cast<size_t>(rings_[first].period);
    for (size_t i = 0; i < group.count; ++i) {
      best[i] = leaving_[before + i] - stay_cost_[shortest + i];
      from[i] = static_cast<uint8_t>(i);
    }
    for (size_t i = 1; i < group.count; ++i) {
      const float other = best[i - 1] - step_cost_[shortest + i - 1];
      if (other > best[i]) best[i] = other, from[i] = from[i - 1];
    }
    for (size_t i = group.count - 1; i-- > 0;) {
      const float other = best[i + 1] - step_cost_[shortest + i];
      if (other > best[i]) best[i] = other, from[i] = from[i + 1];
    }
  }
  back_.insert(back_.end(), from_.begin(), from_.end());
  for (size_t r = 0; r < rings_.size(); ++r) {
    const Ring& ring = rings_[r];
    float* states = &states_[ring.first_state];
    states[ring.zero] = arriving_[r];
    const float* score = place_score_[ring.pattern].data();
    for (const Hit& hit : ring.hits) {
      const int at = ring.zero + hit.at;
      states[at < ring.period ? at : at - ring.period] += score[hit.place];
    }
  }
  ++frames_;
}

size_t BarPointer::BestState(int* frames_since) const {
  float most = -std::numeric_limits<float>::infinity();
  size_t best = 0;
  for (size_t r = 0; r < rings_.size(); ++r) {
    const Ring& ring = rings_[r];
    const auto states =
        std::span(states_).subspan(ring.first_state, static_cast<size_t>(ring.period));
    const auto highest = std::ranges::max_element(states);
    if (*highest <= most) continue;
    most = *highest;
    best = r;
    *frames_since =
        (static_cast<int>(highest - states.begin()) - ring.zero + ring.period) % ring.period;
  }
  return best;
}

BarPointer::Step BarPointer::StepOf(size_t ring, int64_t frame) const {
  const Ring& of = rings_[ring];
  return {frame, of.period, of.beat, of.pattern, patterns_[of.pattern].beats};
}

std::vector<BarPointer::Step> BarPointer::Path() const {
  std::vector<Step> path;
  if (rings_.empty() || frames_ == 0) return path;
  int since = 0;
  size_t ring = BestState(&since);
  int64_t frame = frames_ - 1 - since;
  while (frame >= 0) {
    path.push_back(StepOf(ring, frame));
    const auto group = std::ranges::find_if(groups_, [ring](const Group& g) {
      return ring >= g.first_ring && ring < g.first_ring + g.count;
    });
    ring = groups_[group->before].first_ring +
           back_[static_cast<size_t>(frame) * rings_.size() + ring];
    frame -= rings_[ring].period;
  }
  std::ranges::reverse(path);
  return path;
}

}  // namespace choreo
