#pragma once

#include "model/papers/networks/controllers_model.h"
#include "model/papers/training/control_clips.h"
#include "model/training/trainer/loss_terms.h"

namespace choreo {

/// The five losses of paper C (Section 3.3) with its weights: L_rec, L_con, L_root, L_key, L_vfac.
/// docs/decisions.md explains their units.
LossTerms ControlLoss(ControllersModelImpl& model, const ControlBatch& batch,
                      const ControlledOutput& output);

/// The keyframe consistency loss (Eq. 10) as intended, [batch], m^2: distances of the first 5
/// frames from the history's last pose and of the last 5 from the target. With at most 10 frames:
/// distances of each frame from both poses, weighted by nearness. `positions` are [batch, N,
/// features], the two poses [batch, features].
torch::Tensor KeyframeLoss(const torch::Tensor& positions, const torch::Tensor& first,
                           const torch::Tensor& last);

}  // namespace choreo
