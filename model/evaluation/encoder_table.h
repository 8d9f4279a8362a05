#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/core/progress.h"
#include "model/evaluation/method.h"
#include "model/evaluation/motion_encoder.h"
#include "model/evaluation/table.h"

namespace choreo {

/// Mean over all pairs of dances of the mean squared distance of their corresponding windows, over
/// their common length. `dances`: codes [codes, windows] each. 0 for fewer than two.
double MeanApart(const std::vector<Eigen::MatrixXd>& dances);

/// FID, variability and diversity of paper F's Table 1 (Sections 4.5.2 and 4.5.4), in the codes of
/// one encoder, of dances of 10 s beside the clips of a set. A code's unit is the standard
/// deviation of that code over the training windows, so all three are in its square, and add up
/// over the 32 codes: two windows drawn at random from training motion are 64 apart.
///   FID          Frechet distance of the dances' windows to real motion's
///   variability  MeanApart of 15 dances with one input and different seeds, mean over inputs
///   diversity    MeanApart of dances of different inputs
/// Real motion is cut into blocks of 5 s, even and odd: the even ones are what all rows are
/// compared with, the odd ones are its own row.
Table EvaluateEncoded(const ClipSet& set, const std::vector<Method>& methods,
                      const MotionEncoder& encoder, const EvalOptions& options,
                      ProgressBar* progress);

/// How many frames that will dance.
int64_t CountEncodedFrames(const ClipSet& set, const std::vector<Method>& methods,
                           const EvalOptions& options);

}  // namespace choreo
