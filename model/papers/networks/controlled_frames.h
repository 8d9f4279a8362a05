#pragma once

#include <torch/types.h>

#include "model/motion/skeleton.h"

/// Motion as tensors for the controllers network: batches of paper C's p^r, o^r, p^b and c (Section
/// 3.1), in the canonical frame, metres.
namespace choreo {

/// T consecutive frames.
struct FrameTensors {
  torch::Tensor root;      ///< [batch, T, 3]
  torch::Tensor facing;    ///< [batch, T, 2] sine and cosine of the heading
  torch::Tensor joints;    ///< [batch, T, joints - 1, 3] from the root, turned to face +Z
  torch::Tensor contacts;  ///< [batch, T, 4] in [0, 1]

  int64_t size() const { return root.size(1); }
  FrameTensors Narrow(int64_t first, int64_t count) const;
};
FrameTensors Join(const FrameTensors& a, const FrameTensors& b);

/// The inputs of a batch of equally long transitions.
struct ControlledTransition {
  int64_t frames = 0;           ///< N
  FrameTensors history;         ///< tau frames; the last one is above the origin and faces +Z
  torch::Tensor target_joints;  ///< [batch, joints - 1, 3]
  torch::Tensor target_turn;    ///< [batch] heading of the target, radians; counts whole turns
  torch::Tensor has_target;     ///< [batch, 1] in {0, 1}
  torch::Tensor path;           ///< [batch, N, 3] requested root positions
  torch::Tensor factors;        ///< [batch, N, 5] velocity factors, metres a frame
};

/// Rotates vectors [..., 3] about +Y by headings [..., 2] (sine, cosine; broadcast), or back.
torch::Tensor Turn(const torch::Tensor& vectors, const torch::Tensor& facing);
torch::Tensor TurnBack(const torch::Tensor& vectors, const torch::Tensor& facing);
/// Sine and cosine of the angles a + b and a - b.
torch::Tensor AddHeadings(const torch::Tensor& a, const torch::Tensor& b);
torch::Tensor SubtractHeadings(const torch::Tensor& a, const torch::Tensor& b);
torch::Tensor HeadingOf(const torch::Tensor& angle);  ///< [...] -> [..., 2]

/// Positions [batch, T, joints, 3]: the root's, then the other joints' relative to the root, in the
/// scene's axes.
torch::Tensor RelativePositions(const FrameTensors& frames);
/// Differences of RelativePositions from frame to frame, [batch, T - 1, joints, 3].
torch::Tensor Steps(const FrameTensors& frames);
/// Velocity factors [..., 5] (paper C, Eq. 1) of Steps' differences [..., joints, 3], given
/// `shares` [5, joints].
torch::Tensor FactorsOf(const torch::Tensor& steps, const torch::Tensor& shares);
torch::Tensor SharesOf(const Skeleton& skeleton);  ///< WeighBodyParts, [5, joints]

}  // namespace choreo
