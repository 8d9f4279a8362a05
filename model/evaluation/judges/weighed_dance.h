#pragma once

#include <span>
#include <vector>

#include "model/evaluation/table.h"
#include "model/metrics/balance.h"
#include "model/metrics/critic_families.h"

namespace choreo {

/// Figures of the weight of a dance or recording.
struct WeighedDance {
  size_t clip = 0;  ///< index in its set
  WeightFigures weight;
  double floor = 0;  ///< DancedFloor, m
  double half_turns = 0,
         whole_turns = 0;  ///< shares of windows of 2 s that turn > 150 and > 270 degrees
  double lean = 0;         ///< the median TrunkLean, degrees
  double bent = 0;         ///< share of poses that lean > 45 degrees
  double at_rest = 0;      ///< HandsAtRest
  double spread = 0;       ///< PaceSpread
  FamilyWindows windows;   ///< features for the critics
};
using WeighedDances = std::vector<WeighedDance>;

/// Measures a dance. `turns`: its WindowTurns. Throws Error(kInvalidArgument) for a skeleton that
/// BalanceGauge doesn't fit.
WeighedDance Weigh(const Skeleton& skeleton, double fps, size_t clip, const JointTrack& track,
                   const std::vector<double>& turns);

/// A figure of weighed dances in tables, with its unit.
struct WeightRow {
  const char* name;
  double (*figure)(const WeighedDance&);
  double unit;  ///< tables multiply figures by this
};
/// All rows: first about standing and falling, then about variation.
std::span<const WeightRow> WeightRows();

/// The mean over the dances whose figure is not NaN.
Cell MeanOfKnown(const WeighedDances& dances, double (*figure)(const WeighedDance&), double unit);

}  // namespace choreo
