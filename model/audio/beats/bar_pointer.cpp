#include "model/audio/beats/bar_pointer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "model/audio/signal/format.h"
#include "model/core/running/each_cpu.h"

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

// What changing to the next slower tempo costs, and staying, by period.
struct Costs {
  static constexpr int kLongest = 128;  // frames
  std::array<float, kLongest> step{}, stay{};

  Costs() {
    for (int period = 1; period < kLongest; ++period) {
      const auto i = static_cast<size_t>(period);
      step[i] = static_cast<float>(kTempoCost * std::log((period + 1.0) / period));
      double sum = 0;
      for (int to = std::max(1, period / 2); to <= 2 * period; ++to)
        sum += std::exp(-kTempoCost * std::abs(std::log(double{1} * to / period)));
      stay[i] = static_cast<float>(std::log(sum));
    }
  }

  static const Costs& Shared() {
    static const Costs costs;
    return costs;
  }
};

// The beats of a bar, side by side in a register.
typedef float Lanes __attribute__((vector_size(16)));
typedef int IntLanes __attribute__((vector_size(16)));

inline Lanes Load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline IntLanes LoadInts(const int* from) {
  IntLanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

// Goes from each tempo to the next one, `ahead` or back, where that is better than what reaches
// it. `cost` is of the step between a tempo and the next slower one.
template <int kStep>
[[gnu::always_inline]] inline void ChangeTempo(float* best, int* from, const float* cost,
                                               size_t tempi) {
  constexpr std::ptrdiff_t kLanes = 4;
  const std::ptrdiff_t first = kStep > 0 ? 0 : static_cast<std::ptrdiff_t>(tempi) - 1;
  Lanes score = Load(best + first * kLanes);
  IntLanes origin = LoadInts(from + first * kLanes);
  for (size_t left = tempi; left > 1; --left) {
    const std::ptrdiff_t by = kStep > 0 ? static_cast<std::ptrdiff_t>(tempi - left)
                                        : static_cast<std::ptrdiff_t>(left) - 1;
    const std::ptrdiff_t to = by + kStep;
    const Lanes other = score - cost[kStep > 0 ? by : to], own = Load(best + to * kLanes);
    const IntLanes better = other > own;
    origin = better ? origin : LoadInts(from + to * kLanes);
    score = other > own ? other : own;
    std::memcpy(best + to * kLanes, &score, sizeof score);
    std::memcpy(from + to * kLanes, &origin, sizeof origin);
  }
}

CHOREO_EACH_CPU void ChangeTempi(float* best, int* from, const float* cost, size_t tempi) {
  ChangeTempo<1>(best, from, cost, tempi);
  ChangeTempo<-1>(best, from, cost, tempi);
}

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
  for (Tempo& tempo : tempi_) {
    tempo.first_score = scores_.size();
    scores_.resize(scores_.size() + static_cast<size_t>(tempo.period) * kBeats,
                   static_cast<float>(-std::log(tempo.period)));
  }
  place_scores_.resize(parts_.size() * kScores * kHistory);
  beginning_.resize(place_scores_.size());
  best_.resize(tempi_.size() * kBeats);
  from_.resize(best_.size());
}

void BarPointer::AddPart(size_t nth, const Limits& limits) {
  const BarPattern& pattern = patterns_[nth];
  const int shortest = PeriodOf(std::min(pattern.fastest_bpm, limits.fastest_bpm));
  const int longest = PeriodOf(std::max(pattern.slowest_bpm, limits.slowest_bpm));
  if (shortest > longest) return;
  const size_t first = parts_.size() * kScores, beats = static_cast<size_t>(pattern.beats);
  parts_.push_back(
      {nth, beats, tempi_.size(), static_cast<size_t>(longest - shortest + 1), first, {}});
  for (size_t beat = 0; beat < kBeats; ++beat)
    parts_.back().previous[beat] = beat < beats ? (beat + beats - 1) % beats : beat;
  for (size_t band = 0; band < Onset::kBands; ++band) {
    constant_[band].resize(first + kScores);
    slope_[band].resize(first + kScores);
    for (size_t i = 0; i < pattern.rise.size(); ++i) {
      const double mean = pattern.rise[i][band];
      const size_t at = first + i % kPlaces * kBeats + i / kPlaces;
      // Log of the exponential density, relative to that between the places.
      constant_[band][at] = kWeight * std::log(kBetween / mean);
      slope_[band][at] = kWeight * (1 / kBetween - 1 / mean);
    }
  }
  for (int period = shortest; period <= longest; ++period) {
    Tempo tempo{0, period, 0, {}};
    tempo.begin.fill(kNowhere);
    for (size_t place = 0; place < pattern.places; ++place) {
      const double at = pattern.place[place];
      // The first one counts of positions too close to distinguish at this tempo.
      const auto is_near = [&](double other) {
        const double apart = std::abs(other - at);
        return period * std::min(apart, 1 - apart) < kFrames + 1;
      };
      if (!std::any_of(pattern.place.begin(), &pattern.place[place], is_near))
        tempo.begin[place] = static_cast<int8_t>(std::lround(period * at) + kFirstFrame);
    }
    tempi_.push_back(tempo);
  }
}

void BarPointer::Add(const Onset& onset) {
  for (const Part& part : parts_) {
    Leave(part);
    Arrive(part);
  }
  back_.insert(back_.end(), from_.begin(), from_.end());
  Score(onset);
  ++frames_;
}

// Scores the places in this frame.
void BarPointer::Score(const Onset& onset) {
  const auto even = even_.Even(onset);
  const size_t places = parts_.size() * kScores;
  std::array<double, kScores> sum;
  for (size_t first = 0; first < places; first += kScores) {
    sum.fill(0);
    for (size_t band = 0; band < even.size(); ++band) {
      if (!(even[band] >= 0)) continue;
      const double* constant = &constant_[band][first];
      const double* slope = &slope_[band][first];
      for (size_t i = 0; i < kScores; ++i) sum[i] += constant[i] + slope[i] * even[band];
    }
    std::ranges::copy(sum, &place_scores_[At(frames_) + first]);
  }
  float* beginning = &beginning_[At(frames_ - kFrames + 1)];
  std::fill_n(beginning, places, 0.0F);
  for (int i = 0; i < kFrames; ++i) {
    const float* scores = &place_scores_[At(frames_ - i)];
    for (size_t place = 0; place < places; ++place) beginning[place] += scores[place];
  }
}

// Sets best_ of each beat to the path that stays at its tempo.
void BarPointer::Leave(const Part& part) {
  const Costs& costs = Costs::Shared();
  for (size_t at = part.first_tempo; at < part.first_tempo + part.tempi; ++at) {
    Tempo& tempo = tempi_[at];
    tempo.zero = tempo.zero == 0 ? tempo.period - 1 : tempo.zero - 1;
    Lanes score = Load(&scores_[tempo.first_score + static_cast<size_t>(tempo.zero) * kBeats]) -
                  costs.stay[static_cast<size_t>(tempo.period)];
    const int64_t start = frames_ - tempo.period;
    const float* beginning = &beginning_[part.first_place];
    for (size_t place = 0; place < kPlaces; ++place, beginning += kBeats) {
      if (tempo.begin[place] != kNowhere) score += Load(beginning + At(start + tempo.begin[place]));
    }
    std::array<float, kBeats> scores;
    std::memcpy(scores.data(), &score, sizeof score);
    for (size_t beat = 0; beat < kBeats; ++beat)
      best_[at * kBeats + beat] = scores[part.previous[beat]];
  }
}

// Changes of tempo. Their cost adds up from period to period, so two passes find the best.
void BarPointer::Arrive(const Part& part) {
  float* best = &best_[part.first_tempo * kBeats];
  int* from = &from_[part.first_tempo * kBeats];
  for (size_t tempo = 0; tempo < part.tempi; ++tempo)
    std::fill_n(from + tempo * kBeats, kBeats, static_cast<int>(tempo));
  Tempo* tempi = &tempi_[part.first_tempo];
  ChangeTempi(best, from, &Costs::Shared().step[static_cast<size_t>(tempi->period)], part.tempi);
  for (size_t tempo = 0; tempo < part.tempi; ++tempo) {
    std::copy_n(
        best + tempo * kBeats, kBeats,
        &scores_[tempi[tempo].first_score + static_cast<size_t>(tempi[tempo].zero) * kBeats]);
  }
}

BarPointer::State BarPointer::Best() const {
  float most = -std::numeric_limits<float>::infinity();
  State best{};
  for (size_t nth = 0; nth < parts_.size(); ++nth) {
    const Part& part = parts_[nth];
    for (size_t at = part.first_tempo; at < part.first_tempo + part.tempi; ++at) {
      const Tempo& tempo = tempi_[at];
      Lanes own = Lanes{} - std::numeric_limits<float>::infinity();  // of each beat
      IntLanes own_since{};
      for (int since = 0; since < tempo.period; ++since) {
        // By the frames so far.
        Lanes sum{};
        for (size_t place = 0; place < kPlaces; ++place) {
          if (tempo.begin[place] == kNowhere) continue;
          const int64_t begin = frames_ - 1 - since + tempo.begin[place];
          for (int64_t frame = begin; frame < std::min(begin + kFrames, frames_); ++frame)
            sum += Load(&place_scores_[At(frame) + part.first_place + place * kBeats]);
        }
        const auto start = static_cast<size_t>((tempo.zero + since) % tempo.period);
        const Lanes score = Load(&scores_[tempo.first_score + start * kBeats]) + sum;
        own_since = score > own ? IntLanes{} + since : own_since;
        own = score > own ? score : own;
      }
      for (size_t beat = 0; beat < part.beats; ++beat) {
        if (own[beat] <= most) continue;
        most = own[beat];
        best = {nth, at, beat, own_since[beat]};
      }
    }
  }
  return best;
}

std::vector<BarPointer::Step> BarPointer::Path() const {
  std::vector<Step> path;
  if (tempi_.empty() || frames_ == 0) return path;
  auto [nth, tempo, beat, since] = Best();
  const Part& part = parts_[nth];
  const auto beats = static_cast<int>(part.beats);
  for (int64_t frame = frames_ - 1 - since; frame >= 0; frame -= tempi_[tempo].period) {
    const int period = tempi_[tempo].period;
    path.push_back({frame, period, static_cast<int>(beat), part.pattern, beats});
    const size_t state = static_cast<size_t>(frame) * tempi_.size() + tempo;
    tempo = part.first_tempo + back_[state * kBeats + beat];
    beat = part.previous[beat];
  }
  std::ranges::reverse(path);
  return path;
}

}  // namespace choreo
