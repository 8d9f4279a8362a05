#pragma once

#include "model/papers/networks/controllers_model.h"
#include "model/papers/training/control_clips.h"
#include "model/training/loss_terms.h"

namespace choreo {

/// The five losses of paper C (Section 3.3) with its weights: L_rec, L_con, L_root, L_key, L_vfac.
/// docs/decisions.md explains their units.
LossTerms ControlLoss(ControllersModelImpl& model, const ControlBatch& batch,
                      const ControlledOutput& output);

/// The keyframe consistency loss (Eq. 10) as intended, m^2: of the first 5 frames to the history's
/// last pose and of the last 5 to the target; with at most 10 frames, of each to both, weighted by
/// nearness. Paths of positions [batch, N, features], the two poses [batch, features]. [batch]
torch::Tensor KeyframeLoss(const torch::Tensor& positions, const torch::Tensor& first,
                           const torch::Tensor& last);

}  // namespace choreo
