#pragma once

#include <map>
#include <vector>

#include "model/training/losses.h"

namespace choreo {

/// What a run reports of itself on validation windows: fixed windows, no arrival, one roll-out at
/// the served temperature.
struct ValidationRow {
  int frames = 0;              ///< N
  double interpolation_m = 0;  ///< L2P of interpolation
  double planner_m = 0;        ///< L2P of the plan (0 without a planner)
  double flow_m = 0;           ///< L2P of a sampled roll-out (0 before the flow's stage)
  double likelihood = 0;       ///< -log p, nats a dimension
  double key_error_m = 0;      ///< raw: joint distance at the key frame of the roll-out
};

/// Deterministic: the same windows and noise at every call. `with_flow` also samples.
std::vector<ValidationRow> Validate(FlowModel& model, const ClipStore& clips,
                                    const std::vector<int>& lengths, int windows, bool with_flow);

}  // namespace choreo
