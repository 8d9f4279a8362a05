#pragma once

#include "model/evaluation/evaluation.h"
#include "model/evaluation/tables/liveliness_figures.h"

namespace choreo {

/// The speed of joints in each band of SpeedSpectrum: the square root of danced over real power,
/// left and right combined, one row per joint. `real` and `danced` are not empty.
Table BandTable(const Evaluation& evaluation, const Method& method, const LivelinessDances& real,
                const LivelinessDances& danced);

}  // namespace choreo
