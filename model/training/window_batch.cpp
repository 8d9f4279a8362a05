#include "model/training/window_batch.h"

#include <torch/torch.h>

#include <utility>

#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

template <typename Matrix>
torch::Tensor Columns(const Matrix& matrix) {  // [rows, columns] → [columns, rows]
  const Eigen::MatrixXf floats = matrix.template cast<float>();
  return torch::from_blob(const_cast<float*>(floats.data()), {floats.cols(), floats.rows()})
      .clone();
}

Eigen::MatrixXd PlacesOf(const Skeleton& skeleton, std::span<const Pose> poses) {
  Eigen::MatrixXd places(3 * skeleton.joints(), static_cast<int>(poses.size()));
  for (size_t i = 0; i < poses.size(); ++i)
    places.col(static_cast<int>(i)) = JointPositions(skeleton, poses[i]).reshaped();
  return places;
}

Eigen::MatrixXd RootsOf(std::span<const Pose> poses) {
  Eigen::MatrixXd roots(3, static_cast<int>(poses.size()));
  for (size_t i = 0; i < poses.size(); ++i) roots.col(static_cast<int>(i)) = poses[i].root_position;
  return roots;
}

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;  // as torch has matrices

// Local rotations, [9 joints, frames].
Eigen::MatrixXd TurnsOf(std::span<const Pose> poses) {
  const Eigen::Index joints = poses.front().rotations.cols();
  Eigen::MatrixXd turns(9 * joints, static_cast<int>(poses.size()));
  for (size_t i = 0; i < poses.size(); ++i) {
    for (Eigen::Index j = 0; j < joints; ++j) {
      const RowMajor3d turn = ExpMap(poses[i].rotations.col(j));
      turns.col(static_cast<int>(i)).segment<9>(9 * j) = turn.reshaped<Eigen::RowMajor>();
    }
  }
  return turns;
}

// How the joints of real motion move with the flow's coordinates, which are rotation vectors `x`
// behind those of the mean: as WindowBatch has axes and bones.
struct Lever {
  Eigen::MatrixXd axes, bones;

  Lever(const Skeleton& skeleton, std::span<const Pose> truth, const Eigen::MatrixXd& x) {
    const int joints = skeleton.joints(), frames = static_cast<int>(truth.size());
    axes.resize(9 * joints, frames);
    bones = Eigen::MatrixXd::Zero(3 * joints, frames);
    JointPlacement placement;
    for (int i = 0; i < frames; ++i) {
      ForwardKinematics(skeleton, truth[i], placement);
      for (int j = 0; j < joints; ++j) {
        const RowMajor3d axis =
            placement.rotations[j] * RightJacobian(x.col(i).segment<3>(3 + 3 * j));
        axes.col(i).segment<9>(9 * j) = axis.reshaped<Eigen::RowMajor>();
        const int parent = skeleton.parents[j];
        if (j > 0)
          bones.col(i).segment<3>(3 * j) =
              placement.positions.col(j) - placement.positions.col(parent);
      }
    }
  }
};

}  // namespace

WindowBatch WindowBatch::To(torch::Device device) const {
  return {.frames = frames,
          .to_key = to_key,
          .z = z.to(device),
          .scales = scales.to(device),
          .surprise = surprise,
          .keyed = keyed.to(device),
          .staged = staged.to(device),
          .mean = mean.to(device),
          .features = features.to(device),
          .whole = whole.to(device),
          .history_joints = history_joints.to(device),
          .base_root = base_root.to(device),
          .base_turns = base_turns.to(device),
          .axes = axes.to(device),
          .bones = bones.to(device)};
}

WindowBatchBuilder::WindowBatchBuilder(const FlowModelParts& model, int frames, int to_key)
    : model_(model), batch_{.frames = frames, .to_key = to_key} {}

bool WindowBatchBuilder::Add(WindowRequest request, std::span<const Pose> truth) {
  const int tau = static_cast<int>(request.history.size()), joints = model_.skeleton.joints();
  const int frames = batch_.frames;
  const FlowWindow window(model_.prior, request);
  const auto x = window.Encode(truth);
  if (!x) return false;
  Eigen::MatrixXd white(x->rows(), x->cols());
  for (int d = 0; d < white.rows(); ++d)
    white.row(d) = window.Whiten(d, x->row(d).transpose()).transpose();
  white = white.cwiseMax(-MotionPrior::kMostWhite).cwiseMin(MotionPrior::kMostWhite);
  Eigen::MatrixXd lines(x->rows(), tau + frames);
  lines << window.history(), window.mean();
  const WindowFeatures described =
      DescribeWindow(model_.skeleton, model_.config, model_.prior, request, window);
  Eigen::VectorXd fixed(white.rows());
  for (int d = 0; d < fixed.size(); ++d) fixed[d] = window.keyed()[d] ? 1 : 0;
  z_.push_back(Columns(white));
  mean_.push_back(Columns(lines));
  staged_.push_back(window.staged() ? 1 : 0);
  batch_.surprise.push_back(window.surprise());
  scales_.push_back(Columns(window.scales()).squeeze(0));
  keyed_.push_back(Columns(fixed).squeeze(0));
  features_.push_back(Columns(described.frames));
  whole_.push_back(Columns(described.whole).squeeze(0));
  history_joints_.push_back(Columns(PlacesOf(model_.skeleton, request.history)));
  const std::vector<Pose> base = window.Decode(Eigen::MatrixXd::Zero(x->rows(), frames));
  base_root_.push_back(Columns(RootsOf(base)));
  base_turns_.push_back(Columns(TurnsOf(base)).view({frames, joints, 3, 3}));
  const Lever lever(model_.skeleton, truth, *x);
  axes_.push_back(Columns(lever.axes).view({frames, joints, 3, 3}));
  bones_.push_back(Columns(lever.bones).view({frames, joints, 3}));
  batch_.truth.emplace_back(truth.begin(), truth.end());
  batch_.requests.push_back(std::move(request));
  return true;
}

WindowBatch WindowBatchBuilder::Build() {
  batch_.z = torch::stack(z_);
  batch_.mean = torch::stack(mean_);
  batch_.scales = torch::stack(scales_);
  batch_.keyed = torch::stack(keyed_);
  batch_.staged = torch::tensor(staged_);
  batch_.features = torch::stack(features_);
  batch_.whole = torch::stack(whole_);
  batch_.history_joints = torch::stack(history_joints_);
  batch_.base_root = torch::stack(base_root_);
  batch_.base_turns = torch::stack(base_turns_);
  batch_.axes = torch::stack(axes_);
  batch_.bones = torch::stack(bones_);
  return std::move(batch_);
}

}  // namespace choreo
