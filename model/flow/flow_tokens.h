#pragma once

#include <Eigen/Core>
#include <span>

/// How the continuous flow's transformer sees a window, whatever computes it.
namespace choreo {

inline constexpr int kFramesAToken = 2;
inline constexpr int kMostTokensApart = 64;  ///< farther ones are told apart no more
inline constexpr int kMlpRatio = 3;          ///< a block's hidden width over its width
inline constexpr int kFlowTimeWidth = 32;    ///< of the flow's embedded time
inline constexpr float kBodyReach = 0.3F;    ///< metres: the spread of joints about the body

/// Sines and cosines of the flow's time `t` in [0, 1]; `embedding` [kFlowTimeWidth].
void EmbedFlowTime(float t, std::span<float> embedding);

/// Of a frame: where the flow is; poses, mean and both's steps; features; joints.
int TokenFrameWidth(int dimensions, int frame_features);

/// Frames in the order that the transformer's input has: [TokenFrameWidth(), frames], filled up in
/// front, by the oldest frame again, to whole tokens. Arguments as FlowNetwork::Evaluate has them;
/// `spread` and `velocity` [dimensions]: units of displacements, and of their steps.
Eigen::MatrixXf FlowTokens(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                           const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                           const Eigen::MatrixXf& frames, const Eigen::VectorXf& spread,
                           const Eigen::VectorXf& velocity);

}  // namespace choreo
