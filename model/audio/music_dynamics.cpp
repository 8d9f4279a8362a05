#include "model/audio/music_dynamics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace choreo {
namespace {

constexpr size_t kStep = 15;  // rows between the seconds examined: half a second

enum Measure : size_t { kLoud, kBusy, kDeep, kMeasures };
using Second = std::array<double, kMeasures>;

Second MeasuresOf(std::span<const RowSound> rows) {
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
std::vector<Second> SecondsOf(std::span<const RowSound> rows) {
  std::vector<Second> seconds;
  for (size_t end = rows.size(); end >= 2 * kStep; end -= kStep)
    seconds.push_back(MeasuresOf(rows.subspan(end - 2 * kStep, 2 * kStep)));
  return seconds;
}

// Mean and deviation of a measure over what sounded, with `usual` added at weight `usual_weight`.
struct Spread {
  double mean = 0, deviation = 0;

  Spread(const std::vector<Second>& seconds, const std::vector<double>& sounding, size_t measure,
         double usual, double usual_weight) {
    double weight = usual_weight, sum = usual_weight * usual, squares = 0;
    for (size_t i = 0; i < seconds.size(); ++i) {
      weight += sounding[i];
      sum += sounding[i] * seconds[i][measure];
    }
    if (weight <= 0) return;
    mean = sum / weight;
    for (size_t i = 0; i < seconds.size(); ++i)
      squares += sounding[i] * std::pow(seconds[i][measure] - mean, 2);
    deviation = std::sqrt(squares / weight);
  }
};

// The energy of the first of these seconds, relative to all.
double EnergyOf(const std::vector<Second>& seconds, const MusicDynamicsOptions& options) {
  double loudest = seconds.front()[kLoud];
  for (const Second& second : seconds) loudest = std::max(loudest, second[kLoud]);
  const double floor = std::max(options.silence, loudest - options.far_below);
  std::vector<double> sounding;
  for (const Second& second : seconds)
    sounding.push_back(std::clamp((second[kLoud] - floor) / options.fade, 0.0, 1.0));

  constexpr double kSecondsAStep = 0.5;
  const auto above = [&](Measure measure, double least, double usual, double usual_seconds) {
    const Spread of(seconds, sounding, measure, usual, usual_seconds / kSecondsAStep);
    const double far = std::max(options.range * of.deviation, least);
    return std::clamp((seconds.front()[measure] - of.mean) / far, -1.0, 1.0);
  };
  const double energy =
      options.loud * above(kLoud, options.least_loud, 0, 0) +
      options.busy * above(kBusy, options.least_busy, options.usual_onsets, options.usual_seconds) +
      options.deep * above(kDeep, options.least_deep, 0, 0);
  return std::lerp(options.silent, energy, sounding.front());
}

}  // namespace

double HearEnergy(std::span<const RowSound> rows, const MusicDynamicsOptions& options) {
  std::vector<Second> seconds =
      SecondsOf(rows.last(std::min<size_t>(rows.size(), kDynamicsMemory)));
  if (seconds.empty()) return 0;
  const double energy = EnergyOf(seconds, options);
  const MusicLevel now = HearLevel(rows, options);
  const MusicLevel before = HearLevel(rows.first(rows.size() - kLevelRows), options);
  if (rows.size() < 2 * kLevelRows || !Turns(before, now, options)) return energy;
  seconds.front() = MeasuresOf(rows.last(static_cast<size_t>(options.turn_heard)));
  return std::max(energy, EnergyOf(seconds, options));
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
