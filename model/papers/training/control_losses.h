#pragma once

#include "model/papers/networks/controllers_model.h"
#include "model/papers/training/control_clips.h"
#include "model/training/loss_terms.h"

namespace choreo {

/// The five losses of paper C (Section 3.3) with its weights, each in units in which it counts
/// (docs/decisions.md): L_rec, L_con, L_root, L_key, L_vfac.
LossTerms ControlLoss(ControllersModelImpl& model, const ControlBatch& batch,
                      const ControlledOutput& output);

/// The keyframe consistency loss (Eq. 10) as it is meant, m^2: the first 5 frames to the history's
/// last pose, the last 5 to the target; of at most 10 frames each to both, by how near they are.
/// Paths of positions [batch, N, features], the two poses [batch, features]. [batch]
torch::Tensor KeyframeLoss(const torch::Tensor& positions, const torch::Tensor& first,
                           const torch::Tensor& last);

}  // namespace choreo
