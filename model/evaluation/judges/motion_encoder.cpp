#include "model/evaluation/judges/motion_encoder.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

constexpr int kWindow = 30;  // frames
constexpr int kStride = 10;  // frames between windows
constexpr int kStep = 3;     // uses every third frame of a window
constexpr int kCodes = 32;   // at most

// Windows of a dance as the encoder's input, [inputs, windows].
Eigen::MatrixXd Windows(const Skeleton& skeleton, std::span<const Pose> poses) {
  const auto length = static_cast<int>(poses.size());
  const int count = length < kWindow ? 0 : 1 + (length - kWindow) / kStride;
  const Eigen::Index size = 3 * skeleton.joints();
  Eigen::MatrixXd windows(size * (kWindow / kStep), count);
  for (int w = 0; w < count; ++w) {
    const auto window = poses.subspan(static_cast<size_t>(w * kStride), kWindow);
    const GroundFrame ground = GroundFrame::Of(window[kWindow / 2]);
    for (int t = 0; t < kWindow / kStep; ++t) {
      windows.col(w).segment(size * t, size) =
          JointPositions(skeleton, ground.ToLocal(window[static_cast<size_t>(t * kStep)]))
              .reshaped();
    }
  }
  return windows;
}

}  // namespace

MotionEncoder::MotionEncoder(const std::vector<ClipSet>& training) {
  // Sums clip by clip to save memory.
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
  mean_ = sum / static_cast<double>(count);
  Eigen::MatrixXd covariance = squares / static_cast<double>(count);
  covariance.selfadjointView<Eigen::Lower>().rankUpdate(mean_, -1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  const Eigen::VectorXd variances = solver.eigenvalues().cwiseMax(0);  // ascending
  const auto codes = std::min<Eigen::Index>(kCodes, (variances.array() > 1e-9).count());
  projection_.resize(codes, variances.size());
  for (Eigen::Index code = 0; code < codes; ++code) {
    const Eigen::Index from = variances.size() - 1 - code;
    projection_.row(code) =
        solver.eigenvectors().col(from).transpose() / std::sqrt(variances[from]);
  }
  explained_ = variances.tail(codes).sum() / std::max(variances.sum(), 1e-12);
  std::string hash = "window " + std::to_string(kWindow) + ", stride " + std::to_string(kStride) +
                     ", step " + std::to_string(kStep) + ", codes " + std::to_string(kCodes);
  for (const ClipSet& set : training) hash = HashOfClips(set.clips, hash);
  version_ = "linear-1/" + hash;
}

Eigen::MatrixXd MotionEncoder::Encode(const Skeleton& skeleton, std::span<const Pose> poses) const {
  const Eigen::MatrixXd windows = Windows(skeleton, poses);
  return projection_ * (windows.colwise() - mean_);
}

double MeanApart(const std::vector<Eigen::MatrixXd>& dances) {
  double sum = 0;
  int pairs = 0;
  for (size_t i = 0; i < dances.size(); ++i) {
    for (size_t k = 0; k < i; ++k, ++pairs) {
      const Eigen::Index common = std::min(dances[i].cols(), dances[k].cols());
      if (common == 0) continue;
      sum +=
          (dances[i].leftCols(common) - dances[k].leftCols(common)).colwise().squaredNorm().mean();
    }
  }
  return pairs > 0 ? sum / pairs : 0;
}

}  // namespace choreo
