#pragma once

#include <span>
#include <vector>

#include "model/evaluation/table.h"
#include "model/metrics/balance.h"
#include "model/metrics/critic_families.h"

namespace choreo {

/// Whether a dance, or a recording, has weight.
struct WeighedDance {
  size_t clip = 0;  ///< within its set
  WeightFigures weight;
  double floor = 0;  ///< DancedFloor, m
  double half_turns = 0,
         whole_turns = 0;  ///< share of windows of 2 s that turn > 150, > 270 degrees
  double at_rest = 0;      ///< HandsAtRest
  double spread = 0;       ///< PaceSpread
  FamilyWindows windows;   ///< what critics see of it
};
using WeighedDances = std::vector<WeighedDance>;

/// `turns`: WindowTurns. Throws Error(kInvalidArgument) for a skeleton that BalanceGauge doesn't
/// fit.
WeighedDance Weigh(const Skeleton& skeleton, double fps, size_t clip, const JointTrack& track,
                   const std::vector<double>& turns);

/// A figure that tables tell of weighed dances, with its unit.
struct WeightRow {
  const char* name;
  double (*figure)(const WeighedDance&);
  double unit;  ///< figures are told times this
};
/// Those of how bodies stand and fall, and those of what they do by turns.
std::span<const WeightRow> WeightRows();

/// Mean over the dances of which the figure is a number.
Cell MeanOfKnown(const WeighedDances& dances, double (*figure)(const WeighedDance&), double unit);

}  // namespace choreo
