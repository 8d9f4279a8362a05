#include "model/evaluation/motion_encoder.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/motion/canonical.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

constexpr int kStep = 3;  // every third frame of a window is looked at

// Windows of a dance as the encoder sees them, [inputs, windows].
Eigen::MatrixXd Windows(const Skeleton& skeleton, std::span<const Pose> poses) {
  constexpr int kFrames = MotionEncoder::kWindow;
  const auto length = static_cast<int>(poses.size());
  const int count = length < kFrames ? 0 : 1 + (length - kFrames) / MotionEncoder::kStride;
  const Eigen::Index size = 3 * skeleton.joints();
  Eigen::MatrixXd windows(size * (kFrames / kStep), count);
  for (int w = 0; w < count; ++w) {
    const auto window = poses.subspan(static_cast<size_t>(w * MotionEncoder::kStride), kFrames);
    const GroundFrame ground = GroundFrame::Of(window[kFrames / 2]);
    for (int t = 0; t < kFrames / kStep; ++t) {
      windows.col(w).segment(size * t, size) =
          JointPositions(skeleton, ground.ToLocal(window[static_cast<size_t>(t * kStep)]))
              .reshaped();
    }
  }
  return windows;
}

// Mean squared distance of corresponding windows of two dances, over their common length.
double Apart(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Eigen::Index common = std::min(a.cols(), b.cols());
  if (common == 0) return 0;
  return (a.leftCols(common) - b.leftCols(common)).colwise().squaredNorm().mean();
}

}  // namespace

MotionEncoder MotionEncoder::Train(const std::vector<ClipSet>& training) {
  // Sums clip by clip, so that not all windows are kept at once.
  Eigen::VectorXd sum;
  Eigen::MatrixXd squares;
  int64_t count = 0;
  for (const ClipSet& set : training) {
    for (const PreparedClip& clip : set.clips) {
      const Eigen::MatrixXd windows = Windows(clip.skeleton, clip.motion.frames);
      if (windows.cols() == 0) continue;
      if (count == 0) {
        sum = Eigen::VectorXd::Zero(windows.rows());
        squares = Eigen::MatrixXd::Zero(windows.rows(), windows.rows());
      }
      sum += windows.rowwise().sum();
      squares.selfadjointView<Eigen::Lower>().rankUpdate(windows);
      count += windows.cols();
    }
  }
  if (count < 2) {
    throw InvalidArgument(
        "training", std::to_string(count) + " windows of motion for the encoder, 2 are needed");
  }
  MotionEncoder encoder;
  encoder.mean_ = sum / static_cast<double>(count);
  Eigen::MatrixXd covariance = squares / static_cast<double>(count);
  covariance.selfadjointView<Eigen::Lower>().rankUpdate(encoder.mean_, -1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  const Eigen::VectorXd variances = solver.eigenvalues().cwiseMax(0);  // ascending
  int codes = 0;
  while (codes < std::min<int>(kCodes, static_cast<int>(variances.size())) &&
         variances[variances.size() - 1 - codes] > 1e-9)
    ++codes;
  encoder.projection_.resize(codes, variances.size());
  for (int code = 0; code < codes; ++code) {
    const Eigen::Index from = variances.size() - 1 - code;
    encoder.projection_.row(code) =
        solver.eigenvectors().col(from).transpose() / std::sqrt(variances[from]);
  }
  encoder.explained_ = variances.tail(codes).sum() / std::max(variances.sum(), 1e-12);
  std::string hash = "window " + std::to_string(kWindow) + ", stride " + std::to_string(kStride) +
                     ", step " + std::to_string(kStep) + ", codes " + std::to_string(kCodes);
  for (const ClipSet& set : training) hash = HashOfClips(set.clips, hash);
  encoder.version_ = "linear-1/" + hash;
  return encoder;
}

Eigen::MatrixXd MotionEncoder::Encode(const Skeleton& skeleton, std::span<const Pose> poses) const {
  const Eigen::MatrixXd windows = Windows(skeleton, poses);
  return projection_ * (windows.colwise() - mean_);
}

double MeanApart(const std::vector<Eigen::MatrixXd>& dances) {
  double sum = 0;
  int pairs = 0;
  for (size_t i = 0; i < dances.size(); ++i) {
    for (size_t k = 0; k < i; ++k, ++pairs) sum += Apart(dances[i], dances[k]);
  }
  return pairs > 0 ? sum / pairs : 0;
}

}  // namespace choreo
