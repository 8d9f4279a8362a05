#include "model/training/windows/window_batch.h"

#include <utility>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr torch::Tensor WindowBatch::*kTensors[] = {
    &WindowBatch::z,          &WindowBatch::scales,         &WindowBatch::keyed,
    &WindowBatch::staged,     &WindowBatch::mean,           &WindowBatch::features,
    &WindowBatch::whole,      &WindowBatch::history_joints, &WindowBatch::base_root,
    &WindowBatch::base_turns, &WindowBatch::axes,           &WindowBatch::bones};

using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;  // torch's matrix layout

// Local rotations, [9 joints, frames].
Eigen::MatrixXd TurnsOf(std::span<const Pose> poses) {
  const Eigen::Index joints = poses.front().rotations.cols();
  Eigen::MatrixXd turns(9 * joints, static_cast<int>(poses.size()));
  for (size_t i = 0; i < poses.size(); ++i) {
    for (Eigen::Index j = 0; j < joints; ++j) {
      const Eigen::Matrix3d turn = ExpMap(poses[i].rotations.col(j));
      turns.col(i).segment<9>(9 * j) = turn.reshaped<Eigen::RowMajor>();
    }
  }
  return turns;
}

// How real motion's joints move with the flow's coordinates: rotation vectors `x`, applied after
// the mean's. See WindowBatch's axes and bones.
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
  WindowBatch there{.frames = frames, .to_key = to_key, .surprise = surprise};
  for (const auto tensor : kTensors) there.*tensor = (this->*tensor).to(device);
  return there;
}

std::optional<WindowBatch> MakeWindow(const FlowModelParts& model, WindowRequest request,
                                      std::span<const Pose> truth) {
  const int tau = static_cast<int>(request.history.size()), joints = model.skeleton.joints();
  const int frames = request.frames;
  const FlowWindow window(model.prior, request);
  const auto x = window.Encode(truth);
  if (!x) return std::nullopt;
  Eigen::MatrixXd white(x->rows(), x->cols());
  for (int d = 0; d < white.rows(); ++d)
    white.row(d) = window.Whiten(d, x->row(d).transpose()).transpose();
  white = white.cwiseMax(-MotionPrior::kMaxWhite).cwiseMin(MotionPrior::kMaxWhite);
  Eigen::MatrixXd lines(x->rows(), tau + frames);
  lines << window.history(), window.mean();
  const WindowFeatures described =
      DescribeWindow(model.skeleton, model.config, model.prior, request, window);
  Eigen::VectorXd fixed(white.rows());
  for (int d = 0; d < fixed.size(); ++d) fixed[d] = window.keyed()[d] ? 1 : 0;
  Eigen::MatrixXd places(3 * joints, tau), roots(3, frames);
  for (int i = 0; i < tau; ++i)
    places.col(i) = JointPositions(model.skeleton, request.history[i]).reshaped();
  const std::vector<Pose> base = window.Decode(Eigen::MatrixXd::Zero(x->rows(), frames));
  for (int i = 0; i < frames; ++i) roots.col(i) = base[i].root_position;
  const Lever lever(model.skeleton, truth, *x);
  WindowBatch batch{.frames = frames,
                    .to_key = request.to_key,
                    .z = Columns(white),
                    .scales = Columns(window.scales()),
                    .surprise = {window.surprise()},
                    .keyed = Columns(fixed).squeeze(0),
                    .staged = torch::tensor(window.staged() ? 1.0F : 0.0F),
                    .mean = Columns(lines),
                    .features = Columns(described.frames),
                    .whole = Columns(described.whole).squeeze(0),
                    .history_joints = Columns(places),
                    .base_root = Columns(roots),
                    .base_turns = Columns(TurnsOf(base)).view({frames, joints, 3, 3}),
                    .axes = Columns(lever.axes).view({frames, joints, 3, 3}),
                    .bones = Columns(lever.bones).view({frames, joints, 3})};
  batch.truth.emplace_back(truth.begin(), truth.end());
  batch.requests.push_back(std::move(request));
  return batch;
}

WindowBatch Stack(std::vector<WindowBatch> windows) {
  WindowBatch batch{.frames = windows.front().frames, .to_key = windows.front().to_key};
  for (const auto tensor : kTensors) {
    std::vector<torch::Tensor> rows;
    for (const WindowBatch& window : windows) rows.push_back(window.*tensor);
    batch.*tensor = torch::stack(rows);
  }
  for (WindowBatch& window : windows) {
    batch.surprise.push_back(window.surprise.front());
    batch.requests.push_back(std::move(window.requests.front()));
    batch.truth.push_back(std::move(window.truth.front()));
  }
  return batch;
}

}  // namespace choreo
