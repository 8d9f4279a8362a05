#include "model/flow/window/flow_tokens.h"

#include <cmath>

namespace choreo {

void EmbedFlowTime(float t, std::span<float> embedding) {
  constexpr float kScale = 100;             // so that the embedding resolves small steps
  constexpr double kMaxPeriodRatio = 1000;  // ratio of the fastest to the slowest
  const size_t half = embedding.size() / 2;
  for (size_t i = 0; i < half; ++i) {
    const double rate =
        std::pow(kMaxPeriodRatio, -static_cast<double>(i) / static_cast<double>(half));
    const float phase = kScale * t * static_cast<float>(rate);
    embedding[i] = std::sin(phase);
    embedding[half + i] = std::cos(phase);
  }
}

int TokenFrameWidth(int dimensions, int frame_features) {
  return 6 * dimensions - 3 + frame_features;  // joints exclude the root
}

Eigen::MatrixXf FlowTokens(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                           const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                           const Eigen::MatrixXf& frames, const Eigen::VectorXf& spread,
                           const Eigen::VectorXf& velocity) {
  const Eigen::Index dimensions = z.rows(), count = poses.cols(), added = count % kFramesAToken;
  Eigen::MatrixXf x = Eigen::MatrixXf::Zero(
      TokenFrameWidth(static_cast<int>(dimensions), static_cast<int>(frames.rows())),
      count + added);
  Eigen::Index row = 0;
  const auto next = [&](Eigen::Index rows) {
    row += rows;
    return x.block(row - rows, added, rows, count);
  };
  next(dimensions).rightCols(z.cols()) = z;
  for (const Eigen::MatrixXf* way : {&poses, &mean}) {
    next(dimensions) = way->array().colwise() / spread.array();
    next(dimensions).rightCols(count - 1) =
        (way->rightCols(count - 1) - way->leftCols(count - 1)).array().colwise() / velocity.array();
  }
  next(frames.rows()) = frames;
  next(joints.rows()) = joints / kBodyReach;
  if (added > 0) x.col(0) = x.col(1);
  return x;
}

}  // namespace choreo
