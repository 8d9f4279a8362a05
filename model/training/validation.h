#pragma once

#include <vector>

#include "model/training/losses.h"
#include "model/training/report_row.h"

namespace choreo {

/// Deterministic: the same windows and noise at every call.
std::vector<ValidationRow> Validate(FlowModel& model, const ClipStore& clips,
                                    const std::vector<int>& lengths, int windows);

}  // namespace choreo
