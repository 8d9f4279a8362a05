#include "model/audio/music/music_dynamics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "model/core/grid.h"

namespace choreo {
namespace {

constexpr size_t kStep = 15;                    // rows between the seconds examined: half a second
constexpr size_t kAround = kTypicalFrames / 2;  // rows on each side of a step's middle

enum Measure : size_t { kLoud, kBusy, kDeep, kMeasures };
using Stretch = std::array<double, kMeasures>;  // what a stretch of music measures

Stretch MeasuresOf(std::span<const RowSound> rows) {
  double power = 0, bass = 0, onsets = 0;
  for (const RowSound& row : rows) {
    power += row.power;
    bass += row.bass;
    onsets += row.onset;
  }
  const auto count = static_cast<double>(rows.size());
  return {Loudness(power / count), onsets / count, Loudness(bass / count)};
}

// The first is the last second; each overlaps the next by half.
std::vector<Stretch> SecondsOf(std::span<const RowSound> rows) {
  std::vector<Stretch> seconds;
  for (size_t end = rows.size(); end >= 2 * kStep; end -= kStep)
    seconds.push_back(MeasuresOf(rows.subspan(end - 2 * kStep, 2 * kStep)));
  return seconds;
}

// Mean and deviation of a measure over what sounded, with `usual` added at weight `usual_weight`.
struct Spread {
  double mean = 0, deviation = 0;

  Spread(const std::vector<Stretch>& all, const std::vector<double>& sounding, size_t measure,
         double usual, double usual_weight) {
    double weight = usual_weight, sum = usual_weight * usual, squares = 0;
    for (size_t i = 0; i < all.size(); ++i) {
      weight += sounding[i];
      sum += sounding[i] * all[i][measure];
    }
    if (weight <= 0) return;
    mean = sum / weight;
    for (size_t i = 0; i < all.size(); ++i)
      squares += sounding[i] * std::pow(all[i][measure] - mean, 2);
    deviation = std::sqrt(squares / weight);
  }
};

// The energy of one stretch relative to others of its length, half a second apart.
class EnergyScale {
 public:
  EnergyScale(const std::vector<Stretch>& all, const MusicDynamicsOptions& options)
      : options_(options) {
    double loudest = all.front()[kLoud];
    for (const Stretch& one : all) loudest = std::max(loudest, one[kLoud]);
    floor_ = std::max(options.silence, loudest - options.far_below);
    std::vector<double> sounding;
    for (const Stretch& one : all) sounding.push_back(Sounding(one));
    constexpr double kStep_s = 0.5;
    const double usual_weight = options.usual_seconds / kStep_s;
    spreads_ = {Spread(all, sounding, kLoud, 0, 0),
                Spread(all, sounding, kBusy, options.usual_onsets, usual_weight),
                Spread(all, sounding, kDeep, 0, 0)};
  }

  double Of(const Stretch& stretch) const {
    const auto above = [&](Measure measure, double least) {
      const Spread& of = spreads_[measure];
      const double far = std::max(options_.range * of.deviation, least);
      return std::clamp((stretch[measure] - of.mean) / far, -1.0, 1.0);
    };
    const double energy = options_.loud * above(kLoud, options_.least_loud) +
                          options_.busy * above(kBusy, options_.least_busy) +
                          options_.deep * above(kDeep, options_.least_deep);
    return std::lerp(options_.silent, energy, Sounding(stretch));
  }

 private:
  double Sounding(const Stretch& stretch) const {
    return std::clamp((stretch[kLoud] - floor_) / options_.fade, 0.0, 1.0);
  }

  const MusicDynamicsOptions& options_;
  double floor_;
  std::vector<Spread> spreads_;  // by Measure
};

}  // namespace

double HearEnergy(std::span<const RowSound> rows, const MusicDynamicsOptions& options) {
  std::vector<Stretch> seconds =
      SecondsOf(rows.last(std::min<size_t>(rows.size(), kDynamicsMemory)));
  if (seconds.empty()) return 0;
  const double energy = EnergyScale(seconds, options).Of(seconds.front());
  const MusicLevel now = HearLevel(rows, options);
  const MusicLevel before = HearLevel(rows.first(rows.size() - kLevelRows), options);
  if (rows.size() < 2 * kLevelRows || !Turns(before, now, options)) return energy;
  seconds.front() = MeasuresOf(rows.last(static_cast<size_t>(options.turn_heard)));
  return std::max(energy, EnergyScale(seconds, options).Of(seconds.front()));
}

std::vector<float> SongEnergies(std::span<const RowSound> rows,
                                const MusicDynamicsOptions& options) {
  std::vector<Stretch> steps;
  for (size_t middle = kEnergyRows / 2; middle < rows.size(); middle += kEnergyRows) {
    const size_t first = middle - std::min(middle, kAround);
    const size_t last = std::min(middle + kAround, rows.size());
    steps.push_back(MeasuresOf(rows.subspan(first, last - first)));
  }
  if (steps.empty()) return {};
  const EnergyScale scale(steps, options);
  std::vector<float> energies;
  for (const Stretch& step : steps) energies.push_back(static_cast<float>(scale.Of(step)));
  return energies;
}

double MeanEnergy(std::span<const float> energies, int64_t from, int64_t to,
                  const MusicDynamicsOptions& options) {
  from = std::max<int64_t>(from, 0);
  double sum = 0;
  for (int64_t row = from; row < to; ++row) {
    const auto step = static_cast<size_t>(row / kEnergyRows);
    sum += step < energies.size() ? static_cast<double>(energies[step]) : options.silent;
  }
  return to > from ? sum / static_cast<double>(to - from) : 0;
}

MusicLevel HearLevel(std::span<const RowSound> rows, const MusicDynamicsOptions& options) {
  double power = 0, bass = 0;
  for (const RowSound& row : rows.last(std::min<size_t>(rows.size(), kLevelRows))) {
    power += row.power / kLevelRows;
    bass += row.bass / kLevelRows;
  }
  const double loud = std::max(Loudness(power), options.silence);
  return {loud, std::max(Loudness(bass), loud - options.bass_below)};
}

bool Turns(const MusicLevel& from, const MusicLevel& to, const MusicDynamicsOptions& options) {
  return std::abs(to.loud - from.loud) > options.turn_loud ||
         std::abs(to.deep - from.deep) > options.turn_deep;
}

}  // namespace choreo
