#include "model/training/flow_statistics.h"

#include <torch/torch.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "model/motion/rotation.h"

namespace choreo {

using torch::Tensor;

namespace {

constexpr double kShrinkage = 0.02;     // of correlations over dimensions towards none
constexpr double kRare = 0.025;         // share of windows at either end that count as those before
constexpr size_t kLeastWindows = 16;    // that tell how energy counts
constexpr double kUsualStyle = 20;      // windows without difference that each style begins with
constexpr size_t kLeastEnergies = 100;  // windows that tell how lively the next are
constexpr size_t kLeastTurns = 100;     // windows that tell which way round dancers turn
constexpr int kNewtonRounds = 12;
constexpr double kStill = 1e-3;  // metres or radians: what spreads less is not in the recordings

// A window whose energy is told.
struct LivelyWindow {
  EnergyPrior::Known known;
  EnergyPrior::Levels levels;
  EnergyPrior::Inputs inputs;  // what `known` describes
};

std::vector<LivelyWindow> GatherLively(const FlowModelParts& model,
                                       const std::vector<WindowRequest>& requests, bool keyed) {
  std::vector<LivelyWindow> windows;
  for (const WindowRequest& request : requests) {
    if (request.key.has_value() != keyed) continue;
    const auto told = LevelsOf(request, model.config.median_factors);
    if (!std::ranges::all_of(told, [](const auto& level) { return level.has_value(); })) continue;
    LivelyWindow& window = windows.emplace_back();
    window.known = KnownOfEnergy(model, request, FlowWindow(model.prior, request));
    std::ranges::transform(told, window.levels.begin(), [](const auto& level) { return *level; });
  }
  return windows;
}

// What training saw of each input, but for what is rare.
void MeasureRange(const std::vector<LivelyWindow>& windows, EnergyPrior* measured) {
  for (int input = 0; input < EnergyPrior::kInputs; ++input) {
    std::vector<double> values;
    for (const LivelyWindow& window : windows) values.push_back(window.inputs[input]);
    std::ranges::sort(values);
    const auto rank = static_cast<size_t>(kRare * static_cast<double>(values.size()));
    measured->least[input] = values[rank];
    measured->most[input] = values[values.size() - 1 - rank];
  }
}

}  // namespace

VariancePowers MeasureVariancePowers(const MotionPrior& prior,
                                     const std::vector<WindowBatch>& batches) {
  VariancePowers measured = prior.powers();
  std::vector<Eigen::Vector2d> whole;  // logarithms of surprise and of the mean square
  std::vector<Eigen::Vector4d> parts;  // 1, log surprise, level; log mean square
  for (const WindowBatch& batch : batches) {
    const Tensor squares = batch.z.square().mean(1).to(torch::kFloat64).contiguous();
    for (size_t i = 0; i < batch.surprise.size(); ++i) {
      const Eigen::Map<const Eigen::VectorXd> square(
          squares.data_ptr<double>() + i * squares.size(1), squares.size(1));
      const double surprise = std::log(batch.surprise[i]);
      whole.push_back({surprise, std::log(square.mean())});
      const auto levels = LevelsOf(batch.requests[i], measured.medians);
      for (int part = 0; part < kBodyParts; ++part) {
        double sum = 0;
        int moving = 0;
        for (int d = 0; d < square.size(); ++d) {
          if (measured.parts[d] != part || !prior.Moves(d)) continue;
          sum += square[d];
          ++moving;
        }
        if (const auto& level = levels[part]; level && moving > 0)
          parts.push_back({1, surprise, *level, std::log(sum / moving)});
      }
    }
  }
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& one : whole) mean += one / static_cast<double>(whole.size());
  double both = 0, square = 0;
  for (const auto& one : whole) {
    both += (one[0] - mean[0]) * (one[1] - mean[1]);
    square += (one[0] - mean[0]) * (one[0] - mean[0]);
  }
  measured.surprise = both / square;
  std::ranges::sort(whole, {}, [](const auto& one) { return one[0]; });
  const auto rank = static_cast<size_t>(kRare * whole.size());
  measured.least = std::exp(whole[rank][0]);
  measured.most = std::exp(whole[whole.size() - 1 - rank][0]);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const auto& one : parts) {
    normal += one.head<3>() * one.head<3>().transpose();
    right += one[3] * one.head<3>();
  }
  if (parts.size() < kLeastWindows) return measured;
  const Eigen::Vector3d powers = normal.ldlt().solve(right);
  measured.known_surprise = powers[1];
  measured.level = powers[2];
  // So that squares, not their logarithms, are 1 on average.
  double ratio = 0;
  for (const auto& one : parts) ratio += std::exp(one[3] - powers[1] * one[1] - powers[2] * one[2]);
  measured.offset = std::log(ratio / parts.size());
  return measured;
}

EnergyPrior MeasureEnergy(const FlowModelParts& model, const std::vector<WindowRequest>& requests) {
  EnergyPrior measured(model.config.styles.size());
  std::vector<double> of_style(model.config.styles.size(), kUsualStyle);
  for (const bool keyed : {true, false}) {
    std::vector<LivelyWindow> windows = GatherLively(model, requests, keyed);
    if (windows.size() < kLeastEnergies) continue;
    const auto count = static_cast<double>(windows.size());
    for (const LivelyWindow& window : windows) {
      if (!keyed) break;
      measured.usual_way += *window.known.way / count;
      measured.usual_way_in_world += *window.known.way_in_world / count;
    }
    for (LivelyWindow& window : windows) window.inputs = measured.Describe(window.known);
    using Square = Eigen::Matrix<double, EnergyPrior::kInputs, EnergyPrior::kInputs>;
    Square normal = Square::Identity();  // a little towards zero
    EnergyPrior::Weights right = EnergyPrior::Weights::Zero();
    for (const LivelyWindow& window : windows) {
      normal += window.inputs * window.inputs.transpose();
      right += window.levels * window.inputs.transpose();
    }
    EnergyPrior::Weights& weights = keyed ? measured.keyed : measured.free;
    weights = normal.ldlt().solve(right.transpose()).transpose();
    Eigen::Matrix<double, kBodyParts, kBodyParts> left = 1e-6 * decltype(left)::Identity();
    for (const LivelyWindow& window : windows) {
      const EnergyPrior::Levels off = window.levels - weights * window.inputs;
      left += off * off.transpose() / count;
      const int style = window.known.style;
      if (style < 0) continue;
      measured.styles.col(style) += off;
      ++of_style[style];
    }
    if (keyed) measured.spread = left.llt().matrixL();
    // So that factors, not their logarithms, are right on average: who stands still for a while has
    // a logarithm without bound.
    const EnergyPrior::Levels spread = measured.spread.rowwise().squaredNorm();
    EnergyPrior::Levels real = EnergyPrior::Levels::Zero(), said = real;
    for (const LivelyWindow& window : windows) {
      real.array() += window.levels.array().exp();
      said.array() += (weights * window.inputs + 0.5 * spread).array().exp();
    }
    weights.col(0) += (real.array() / said.array()).log().matrix();
    if (keyed) MeasureRange(windows, &measured);
  }
  for (size_t i = 0; i < of_style.size(); ++i) measured.styles.col(i) /= of_style[i];
  return measured;
}

TurnPrior MeasureTurns(const Skeleton& skeleton, const std::vector<WindowRequest>& requests) {
  using Square = Eigen::Matrix<double, TurnPrior::kInputs, TurnPrior::kInputs>;
  struct Turn {
    TurnPrior::Inputs inputs;
    bool is_other;
  };
  std::vector<Turn> turns;
  for (const WindowRequest& request : requests) {
    const auto inputs = TurnPrior::Describe(skeleton, request);
    if (!inputs || !request.turning) continue;
    const Eigen::Vector3d shorter = TurnPrior::ShorterTurn(request);
    turns.push_back({*inputs, NearerWayRound(shorter, *request.turning) != shorter});
  }
  // Logistic regression by Newton's method, a little towards zero.
  TurnPrior prior;
  for (int round = 0; round < kNewtonRounds && turns.size() >= kLeastTurns; ++round) {
    Square curvature = Square::Identity();
    TurnPrior::Inputs slope = -prior.weights;
    for (const Turn& turn : turns) {
      const double chance = prior.ChanceOfOther(turn.inputs);
      slope += ((turn.is_other ? 1 : 0) - chance) * turn.inputs;
      curvature += chance * (1 - chance) * turn.inputs * turn.inputs.transpose();
    }
    prior.weights += curvature.ldlt().solve(slope);
  }
  return prior;
}

WindowStatistics MeasureWindows(const std::vector<WindowBatch>& batches) {
  const int64_t dimensions = batches.front().z.size(2);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(dimensions, dimensions);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(dimensions);
  double poses = 0;
  for (const WindowBatch& batch : batches) {
    const Tensor z = batch.z.flatten(0, 1).to(torch::kFloat64);
    const Tensor product = torch::matmul(z.t(), z).contiguous();
    products +=
        Eigen::Map<const Eigen::MatrixXd>(product.data_ptr<double>(), dimensions, dimensions);
    const Tensor square =
        batch.mean.square().sum(torch::IntArrayRef{0, 1}).to(torch::kFloat64).contiguous();
    squares += Eigen::Map<const Eigen::VectorXd>(square.data_ptr<double>(), dimensions);
    poses += static_cast<double>(batch.mean.size(0) * batch.mean.size(1));
  }
  const Eigen::VectorXd scale = products.diagonal().cwiseMax(1e-9).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd correlation = scale.asDiagonal() * products * scale.asDiagonal();
  correlation *= 1 - kShrinkage;
  correlation.diagonal().setOnes();
  const Eigen::VectorXd spread = (squares / poses).cwiseSqrt();
  return {Eigen::MatrixXd(correlation.llt().matrixL()), AsTheOthers(spread, kStill)};
}

}  // namespace choreo
