#pragma once

#include "model/evaluation/evaluation.h"
#include "model/evaluation/lively_figures.h"

namespace choreo {

/// The speed of joints in each band of SpeedSpectrum: the square root of danced over real power,
/// left and right combined, one row per joint. `real` and `danced` are not empty.
Table BandTable(const Evaluation& evaluation, const Method& method, const LivelyDances& real,
                const LivelyDances& danced);

}  // namespace choreo
