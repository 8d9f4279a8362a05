#include "model/training/flow_matching.h"

#include <torch/torch.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "model/motion/kinematics.h"

namespace choreo {

using torch::Tensor;

namespace {

constexpr double kAtNoise = 0.2;     // share of samples at t = 0, half of them without noise
constexpr double kNear = 0.01;       // share of the variance below which distances count as squares
constexpr double kShrinkage = 0.15;  // of correlations over dimensions towards none
constexpr const char *kWhite = "white_mse", *kWhere = "where_distance";

Tensor Stack(const std::vector<MotionPrior::Bridge>& bridges) {
  std::vector<Tensor> spreads;
  for (const auto& bridge : bridges) {
    const Eigen::Matrix<float, -1, -1, Eigen::RowMajor> spread = bridge.spread.cast<float>();
    spreads.push_back(
        torch::from_blob(const_cast<float*>(spread.data()), {spread.rows(), spread.cols()})
            .clone());
  }
  return torch::stack(spreads);
}

// Square metres that the joints move on average when the joint turns by a radian about any axis.
Tensor ReachOf(const Skeleton& skeleton) {
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  const int joints = skeleton.joints();
  const Tensor reach = torch::ones({3 + 3 * joints});
  for (int j = 0; j < joints; ++j) {
    double sum = 0;
    for (int k = j + 1; k < joints; ++k) {
      int above = k;
      while (above > j) above = skeleton.parents[static_cast<size_t>(above)];
      if (above == j) sum += (rest.col(k) - rest.col(j)).squaredNorm();
    }
    reach.narrow(0, 3 + 3 * j, 3).fill_(2.0 / 3 * sum / joints);
  }
  return reach;
}

// [batch, w, dimensions] of white coordinates → displacements; `spreads` [dimensions, w, w].
Tensor Colour(const Tensor& spreads, const Tensor& z) {
  return torch::matmul(spreads, z.permute({2, 1, 0})).permute({2, 1, 0});
}

}  // namespace

FlowMatching::FlowMatching(const ContinuousFlow& model)
    : parts_(model->Parts()), reach_(ReachOf(parts_.skeleton)) {
  const Eigen::MatrixXf mixing = parts_.mixing.cast<float>();  // column-major: transposed below
  mixing_ =
      torch::from_blob(const_cast<float*>(mixing.data()), {mixing.cols(), mixing.rows()}).clone();
}

const std::vector<std::string>& FlowMatching::TermNames() {
  static const std::vector<std::string> names = {kWhite, kWhere};
  return names;
}

const FlowMatching::Spreads& FlowMatching::Of(int frames, int to_key) {
  const auto [place, is_new] = spreads_.try_emplace({frames, to_key});
  if (is_new) {
    place->second = {Stack(*parts_.prior.Bridges(frames, to_key)),
                     Stack(*parts_.prior.Bridges(frames, 0))};
  }
  return place->second;
}

LossTerms FlowMatching::Losses(ContinuousFlow& model, const WindowBatch& batch) {
  const int64_t count = batch.z.size(0), window = batch.z.size(1);
  const int64_t tau = batch.mean.size(1) - window;
  const Spreads& spreads = Of(batch.frames, batch.to_key);
  const auto colour = [&](const Tensor& z) {
    return torch::where(batch.keyed.unsqueeze(1) > 0, Colour(spreads.to_key, z),
                        Colour(spreads.free, z));
  };
  const Tensor at_noise = torch::rand({count, 1, 1}) < kAtNoise;
  const Tensor t = torch::where(at_noise, torch::zeros({count, 1, 1}), torch::rand({count, 1, 1}));
  const Tensor silent = at_noise & (torch::rand({count, 1, 1}) < 0.5);
  const Tensor noise =
      torch::matmul(torch::randn(batch.z.sizes()), mixing_) * (1 - silent.to(torch::kFloat32));
  const Tensor a = t.square() + (1 - t).square();
  const Tensor z = (1 - t) * noise + t * batch.z;
  const Tensor wanted = ((1 - t) * batch.z - t * noise) / a.sqrt();
  const Tensor poses =
      torch::cat({batch.mean.narrow(1, 0, tau),
                  batch.mean.narrow(1, tau, window) + batch.scale.view({-1, 1, 1}) * colour(z)},
                 1);
  const Tensor miss =
      model->forward(z, poses, batch.mean, batch.features, batch.whole, t.flatten()) - wanted;
  // Of a window's displacements, by dimension: how far real ones are spread.
  const Tensor variance =
      torch::where(batch.keyed > 0, spreads.to_key.square().sum(torch::IntArrayRef{1, 2}),
                   spreads.free.square().sum(torch::IntArrayRef{1, 2}));
  // Of the motion that F says the flow ends in, not of F itself: near the end little is left to
  // say.
  const Tensor where =
      ((colour(miss).square() * reach_).sum(torch::IntArrayRef{1, 2}) / (variance * reach_).sum(1) +
       kNear)
          .sqrt();
  return {{kWhite, 1.0, miss.square().mean()},
          {kWhere, 1.0, (where * ((1 - t) / a.sqrt()).flatten()).mean()}};
}

WindowStatistics MeasureWindows(const std::vector<WindowBatch>& batches) {
  const int64_t dimensions = batches.front().z.size(2);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(dimensions, dimensions);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(dimensions);
  double poses = 0;
  std::vector<Tensor> known, open;  // logarithms of squares, of each window
  for (const WindowBatch& batch : batches) {
    const Tensor z = batch.z.flatten(0, 1).to(torch::kFloat64);
    const Tensor product = torch::matmul(z.t(), z).contiguous();
    products +=
        Eigen::Map<const Eigen::MatrixXd>(product.data_ptr<double>(), dimensions, dimensions);
    const Tensor square =
        batch.mean.square().sum(torch::IntArrayRef{0, 1}).to(torch::kFloat64).contiguous();
    squares += Eigen::Map<const Eigen::VectorXd>(square.data_ptr<double>(), dimensions);
    poses += static_cast<double>(batch.mean.size(0) * batch.mean.size(1));
    known.push_back(batch.surprise.log());
    open.push_back(batch.z.square().mean(torch::IntArrayRef{1, 2}).log());
  }
  const Eigen::VectorXd scale = products.diagonal().cwiseMax(1e-9).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd correlation = scale.asDiagonal() * products * scale.asDiagonal();
  correlation *= 1 - kShrinkage;
  correlation.diagonal().setOnes();
  const Tensor x = torch::cat(known) - torch::cat(known).mean(), y = torch::cat(open);
  return {((x * (y - y.mean())).sum() / x.square().sum()).item<double>(),
          Eigen::MatrixXd(correlation.llt().matrixL()),
          (squares / poses).cwiseSqrt().cwiseMax(1e-3)};
}

}  // namespace choreo
