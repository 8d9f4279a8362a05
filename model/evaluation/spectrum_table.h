#pragma once

#include "model/evaluation/lively_figures.h"
#include "model/evaluation/table.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// How fast joints go in each band of SpeedSpectrum, over windows of two seconds, as a share of
/// real motion's: the root of the danced power over the real one, floor and height together. A row
/// a joint, left and right as one; the first row is of the root in the world, all others are seen
/// from it. Name, title and note are left to the caller.
Table SpectrumTable(const Skeleton& skeleton, double fps, const LivelyDances& real,
                    const LivelyDances& danced);

}  // namespace choreo
