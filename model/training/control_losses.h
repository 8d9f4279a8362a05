#pragma once

#include "model/controllers/controllers_model.h"
#include "model/training/control_clips.h"
#include "model/training/losses.h"

namespace choreo {

/// The five losses of paper C (Section 3.3) with its weights, each in units in which it counts
/// (docs/decisions.md): L_rec, L_con, L_root, L_key, L_vfac. `stated`: contacts and velocities that
/// the network names beside its frames; null for a plan, which names none.
/// `joints`: how often the joints' positions count within L_rec.
LossTerms ControlLoss(ControllersModelImpl& model, const ControlBatch& batch,
                      const FrameTensors& frames, const ControlledOutput* stated,
                      double joints = 1);

/// The keyframe consistency loss (Eq. 10) as it is meant, m^2: the first 5 frames to the history's
/// last pose, the last 5 to the target; of at most 10 frames each to both, by how near they are.
/// Paths of positions [batch, N, features], the two poses [batch, features]. [batch]
torch::Tensor KeyframeLoss(const torch::Tensor& positions, const torch::Tensor& first,
                           const torch::Tensor& last);

}  // namespace choreo
