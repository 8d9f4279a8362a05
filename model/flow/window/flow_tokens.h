#pragma once

#include <Eigen/Core>
#include <span>

/// The continuous flow's transformer input, on any engine.
namespace choreo {

inline constexpr int kFramesAToken = 2;
inline constexpr int kMaxTokensApart = 64;  ///< larger offsets look alike
inline constexpr int kMlpRatio = 3;         ///< a block's hidden width over its width
inline constexpr int kFlowTimeWidth = 32;   ///< of the flow's embedded time
inline constexpr float kBodyReach = 0.3F;   ///< metres: the spread of joints about the body

/// Sines and cosines of the flow's time `t` in [0, 1]; `embedding` [kFlowTimeWidth].
void EmbedFlowTime(float t, std::span<float> embedding);

/// Width of a frame: the flow's position; poses, mean and their steps; features; joints.
int TokenFrameWidth(int dimensions, int frame_features);

/// The transformer's input: [TokenFrameWidth(), frames], padded in front to whole tokens by
/// repeating the oldest frame. Arguments as in FlowNetwork::Evaluate; `spread` and `velocity`
/// [dimensions]: units of displacements and of their steps.
Eigen::MatrixXf FlowTokens(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                           const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                           const Eigen::MatrixXf& frames, const Eigen::VectorXf& spread,
                           const Eigen::VectorXf& velocity);

}  // namespace choreo
