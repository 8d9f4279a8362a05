#pragma once

#include "model/evaluation/evaluation.h"
#include "model/evaluation/lively_figures.h"

namespace choreo {

/// How fast joints move in each band of SpeedSpectrum: the root of danced over real power, left and
/// right together, one row per joint. Neither may be empty.
Table BandTable(const Evaluation& evaluation, const Method& method, const LivelyDances& real,
                const LivelyDances& danced);

}  // namespace choreo
