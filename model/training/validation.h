#pragma once

#include <vector>

#include "model/training/losses.h"
#include "model/training/report_row.h"

namespace choreo {

/// Deterministic: the same windows and noise at every call. `with_flow` also samples.
std::vector<ValidationRow> Validate(FlowModel& model, const ClipStore& clips,
                                    const std::vector<int>& lengths, int windows, bool with_flow);

}  // namespace choreo
