#pragma once

#include "model/evaluation/evaluation.h"
#include "model/evaluation/lively_figures.h"

namespace choreo {

/// How fast joints move in each band of SpeedSpectrum: the root of the danced power over the real
/// one, left and right as one. A row a joint. Neither may be empty.
Table BandTable(const Evaluation& evaluation, const Method& method, const LivelyDances& real,
                const LivelyDances& danced);

}  // namespace choreo
