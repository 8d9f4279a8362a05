#pragma once

#include <cstdint>
#include <vector>

#include "model/core/progress.h"
#include "model/evaluation/method.h"
#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"

namespace choreo {

/// Transitions that follow the real dance's root path and velocity factors (paper C, Section 4),
/// for models that take them; empty where the judged one takes none. Methods that take none stand
/// beside it without:
///   lrp_SET, avf_SET, art_SET  its Tables 2-4 at 10, 50, 100 and 150 frames: real motion,
///                              interpolation along the path, each network alone and as served
///                              (arrival, foot lock), and without keys
///   lrp_ratio_SET, lrp_turned_SET, control_skate_SET, tremor_SET  of the same dances
///   multipliers_SET, constant_SET  how speeds follow factors (multiplier_tables.h)
///   drawn_SET                  root paths that nobody danced (drawn_table.h)
///   repetition_SET             100 to 250 frames: how much of a dance repeats itself, how much of
///                              its ending holds still
/// The last four with options.all_controls alone. `methods` has exactly one that is named kServed.
/// Deterministic.
std::vector<Table> EvaluateControls(const ClipSet& set, const std::vector<Method>& methods,
                                    const EvalOptions& options, ProgressBar* progress);

/// How many frames that will dance.
int64_t CountControlFrames(const ClipSet& set, const std::vector<Method>& methods,
                           const EvalOptions& options);

}  // namespace choreo
