#pragma once

#include <cstdint>
#include <vector>

#include "model/core/progress.h"
#include "model/evaluation/method.h"
#include "model/evaluation/motion_encoder.h"
#include "model/evaluation/table.h"

namespace choreo {

/// FID, variability and diversity of paper F's Table 1, in the codes of one encoder, of long dances
/// beside the clips of a set:
///   FID          Frechet distance of the dances' windows to real motion's
///   variability  mean squared distance of corresponding windows over all pairs of 15 dances with
///                one input and different seeds, mean over inputs
///   diversity    the same over all pairs of dances of different inputs
/// Real motion is cut into blocks of 5 s, even and odd: the even ones are what all rows are
/// compared with, the odd ones are its own row.
Table EvaluateEncoded(const ClipSet& set, const std::vector<Method>& methods,
                      const MotionEncoder& encoder, const EvalOptions& options,
                      ProgressBar* progress);

/// How many frames that will dance.
int64_t CountEncodedFrames(const ClipSet& set, const std::vector<Method>& methods,
                           const EvalOptions& options);

}  // namespace choreo
