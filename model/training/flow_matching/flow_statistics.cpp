#include "model/training/flow_matching/flow_statistics.h"

#include <torch/types.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "model/flow/flow_sampler.h"
#include "model/flow/window/window_energy.h"
#include "model/motion/rotation.h"

namespace choreo {

using torch::Tensor;

namespace {

constexpr double kShrinkage = 0.02;  // shrinkage of correlations between dimensions towards zero
constexpr double kRare = 0.025;      // share of windows at either end that are clipped as rare
constexpr size_t kMinWindows = 16;   // needed to learn how energy counts
constexpr double kPriorStyleWindows = 20;  // number of average windows that each style starts with
constexpr size_t kMinEnergyWindows = 100;  // windows needed to learn the energy of the next
constexpr size_t kMinTurnWindows = 100;    // windows needed to learn which way round dancers turn
constexpr int kNewtonRounds = 12;
constexpr double kStill = 1e-3;  // metres or radians: less spread means absent from the recordings

// A window with known energy.
struct EnergyWindow {
  EnergyPrior::Known known;
  EnergyPrior::Levels levels;
  EnergyPrior::Inputs inputs;  // what `known` describes
};

std::vector<EnergyWindow> GatherEnergies(const FlowModelParts& model,
                                         const std::vector<WindowRequest>& requests, bool keyed) {
  std::vector<EnergyWindow> windows;
  for (const WindowRequest& request : requests) {
    if (request.target.has_value() != keyed) continue;
    const auto levels = LevelsOf(request, model.config.median_factors);
    if (!std::ranges::all_of(levels, [](const auto& level) { return level.has_value(); })) continue;
    EnergyWindow& window = windows.emplace_back();
    window.known = KnownOfEnergy(model, request, FlowWindow(model.prior, request));
    std::ranges::transform(levels, window.levels.begin(), [](const auto& level) { return *level; });
  }
  return windows;
}

// The range of each input in training, except rare values.
void MeasureRange(const std::vector<EnergyWindow>& windows, EnergyPrior* measured) {
  for (int input = 0; input < EnergyPrior::kInputs; ++input) {
    std::vector<double> values;
    for (const EnergyWindow& window : windows) values.push_back(window.inputs[input]);
    std::ranges::sort(values);
    const auto rank = static_cast<size_t>(kRare * static_cast<double>(values.size()));
    measured->least[input] = values[rank];
    measured->most[input] = values[values.size() - 1 - rank];
  }
}

// A frame of a body part with known energy: 1, log surprise, level; and its mean square.
struct EnergyFrame {
  Eigen::Vector3d inputs;
  double square;
};

// Fits the logarithm of the variance to its inputs by maximum likelihood of Gaussians, with
// Newton's method.
Eigen::Vector3d FitLogVariance(const std::vector<EnergyFrame>& frames) {
  double mean = 0;
  for (const EnergyFrame& frame : frames) mean += frame.square / static_cast<double>(frames.size());
  Eigen::Vector3d powers(std::log(mean), 0, 1);
  for (int round = 0; round < kNewtonRounds; ++round) {
    Eigen::Matrix3d curvature = 1e-6 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();
    for (const auto& [inputs, square] : frames) {
      const double share = square * std::exp(-powers.dot(inputs));
      slope += (share - 1) * inputs;
      curvature += share * inputs * inputs.transpose();
    }
    powers += curvature.ldlt().solve(slope);
  }
  return powers;
}

}  // namespace

VariancePowers MeasureVariancePowers(const MotionPrior& prior,
                                     const std::vector<WindowBatch>& batches) {
  VariancePowers measured = prior.powers();
  std::vector<Eigen::Vector2d> whole;  // logarithms of surprise and of the mean square
  std::vector<EnergyFrame> frames;
  for (const WindowBatch& batch : batches) {
    const Tensor squares = batch.z.square().to(torch::kFloat64).contiguous();
    const int64_t dimensions = squares.size(2);
    for (size_t i = 0; i < batch.surprise.size(); ++i) {
      const Eigen::Map<const Eigen::MatrixXd> square(
          squares.data_ptr<double>() + i * batch.frames * dimensions, dimensions, batch.frames);
      const double surprise = std::log(batch.surprise[i]);
      whole.push_back({surprise, std::log(square.mean())});
      const Eigen::MatrixXd levels = LevelCurves(batch.requests[i], measured.medians);
      for (int part = 0; part < kBodyParts; ++part) {
        Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(batch.frames);
        int moving = 0;
        for (int d = 0; d < dimensions; ++d) {
          if (measured.parts[d] != part || !prior.Moves(d)) continue;
          sum += square.row(d);
          ++moving;
        }
        for (int t = 0; t < batch.frames && moving > 0; ++t) {
          if (!std::isnan(levels(part, t)))
            frames.push_back({{1, surprise, levels(part, t)}, sum[t] / moving});
        }
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
  if (frames.size() < kMinWindows) return measured;
  const Eigen::Vector3d powers = FitLogVariance(frames);
  measured.offset = powers[0];
  measured.known_surprise = powers[1];
  measured.level = powers[2];
  std::vector<double> logs;
  for (const EnergyFrame& frame : frames) logs.push_back(powers.dot(frame.inputs));
  const auto calm = logs.begin() + static_cast<int64_t>(kRare * static_cast<double>(logs.size()));
  std::ranges::nth_element(logs, calm);
  measured.least_scale = std::exp(0.5 * *calm);
  return measured;
}

EnergyCurve MeasureCurve(std::span<const ClipTrack> tracks,
                         const std::array<double, kBodyParts>& medians) {
  using Square = Eigen::Matrix<double, kBodyParts, kBodyParts>;
  std::vector<Eigen::MatrixXd> levels;
  for (const ClipTrack& track : tracks) {
    Eigen::MatrixXd& of_clip = levels.emplace_back(track.energy);
    for (int part = 0; part < kBodyParts; ++part) {
      for (double& energy : of_clip.row(part))
        energy = EnergyLevel(energy, medians[static_cast<size_t>(part)]);
    }
  }
  // Measures each clip relative to its own mean, because dancers differ. Logarithms of stillness
  // are unbounded, so the livelier frames determine the range of levels.
  Square all = Square::Zero();
  EnergyPrior::Levels above = EnergyPrior::Levels::Zero(), lively = above;
  Eigen::Index frames = 0;
  for (const Eigen::MatrixXd& clip : levels) {
    const Eigen::MatrixXd off = clip.colwise() - clip.rowwise().mean();
    all += off * off.transpose();
    above += off.cwiseMax(0).rowwise().squaredNorm();
    lively += (off.array() > 0).cast<double>().rowwise().sum().matrix();
    frames += clip.cols();
  }
  all /= static_cast<double>(std::max<Eigen::Index>(1, frames));
  EnergyCurve curve;
  for (int lag = 0; lag < EnergyCurve::kLags; ++lag) {
    double squares = 0;  // of differences over this lag; half their mean is the loss of correlation
    Eigen::Index count = 0;
    for (const Eigen::MatrixXd& clip : levels) {
      const Eigen::Index pairs = std::max<Eigen::Index>(0, clip.cols() - lag);
      squares += (clip.rightCols(pairs) - clip.leftCols(pairs)).squaredNorm();
      count += pairs;
    }
    if (count == 0) return {};
    const double kept = 1 - 0.5 * squares / static_cast<double>(count) / all.trace();
    curve.correlation[lag] = std::clamp(kept, -1.0, 1.0);
  }
  // Averages both sides.
  const Eigen::PermutationMatrix<kBodyParts> mirror(Eigen::Vector<int, kBodyParts>(0, 2, 1, 4, 3));
  const EnergyPrior::Levels scale =
      (above.array() / lively.array().max(1) / all.diagonal().array().max(1e-9)).sqrt();
  const Square upper = scale.asDiagonal() * all * scale.asDiagonal();
  Square covariance = 0.5 * (upper + mirror * upper * mirror.transpose());
  covariance.diagonal().array() += 1e-6;
  curve.spread = covariance.llt().matrixL();
  return curve;
}

EnergyPrior MeasureEnergy(const FlowModelParts& model, const std::vector<WindowRequest>& requests) {
  EnergyPrior measured(model.config.styles.size());
  std::vector<double> of_style(model.config.styles.size(), kPriorStyleWindows);
  for (const bool keyed : {true, false}) {
    std::vector<EnergyWindow> windows = GatherEnergies(model, requests, keyed);
    if (windows.size() < kMinEnergyWindows) continue;
    const auto count = static_cast<double>(windows.size());
    for (const EnergyWindow& window : windows) {
      if (!keyed) break;
      measured.usual_way += *window.known.way / count;
      measured.usual_way_in_world += *window.known.way_in_world / count;
    }
    for (EnergyWindow& window : windows) window.inputs = measured.Describe(window.known);
    using Square = Eigen::Matrix<double, EnergyPrior::kInputs, EnergyPrior::kInputs>;
    Square normal = Square::Identity();  // slight shrinkage towards zero
    EnergyPrior::Weights right = EnergyPrior::Weights::Zero();
    for (const EnergyWindow& window : windows) {
      normal += window.inputs * window.inputs.transpose();
      right += window.levels * window.inputs.transpose();
    }
    EnergyPrior::Weights& weights = keyed ? measured.keyed : measured.free;
    weights = normal.ldlt().solve(right.transpose()).transpose();
    Eigen::Matrix<double, kBodyParts, kBodyParts> left = 1e-6 * decltype(left)::Identity();
    for (const EnergyWindow& window : windows) {
      const EnergyPrior::Levels off = window.levels - weights * window.inputs;
      left += off * off.transpose() / count;
      const int style = window.known.style;
      if (style < 0) continue;
      measured.styles.col(style) += off;
      ++of_style[style];
    }
    if (keyed) measured.spread = left.llt().matrixL();
    // Averages factors, not their logarithms, because a still dancer's logarithm is unbounded.
    const EnergyPrior::Levels spread = measured.Variance();
    EnergyPrior::Levels real = EnergyPrior::Levels::Zero(), predicted = real;
    for (const EnergyWindow& window : windows) {
      real.array() += window.levels.array().exp();
      predicted.array() += (weights * window.inputs + 0.5 * spread).array().exp();
    }
    weights.col(0) += (real.array() / predicted.array()).log().matrix();
    if (keyed) MeasureRange(windows, &measured);
  }
  for (size_t i = 0; i < of_style.size(); ++i) measured.styles.col(i) /= of_style[i];
  return measured;
}

EnergyResponse MeasureResponse(const FlowModelParts& model, const FlowNetwork& network,
                               const std::vector<WindowRequest>& requests) {
  EnergyResponse response;
  if (requests.size() < kMinEnergyWindows) return response;
  using Row = Eigen::Array<double, kBodyParts, 1>;
  Row levels = Row::Zero(), danced = levels, squares = levels, products = levels;
  const auto count = static_cast<double>(requests.size());
  for (size_t i = 0; i < requests.size(); ++i) {
    WindowRequest request = requests[i];
    std::vector<Pose> poses =
        SampleWindow(model, network, request, {.seed = i, .temperature = 1}).Finish();
    poses.insert(poses.begin(), request.history.back());
    const auto factors = MeanPartSpeeds(model.skeleton, poses);
    Row level, sampled;
    for (int part = 0; part < kBodyParts; ++part) {
      const auto at = static_cast<size_t>(part);
      const double median = model.config.median_factors[at];
      level[part] = EnergyLevel(request.controls[kVelocityFactors].values.row(part).mean(), median);
      sampled[part] = EnergyLevel(factors[at], median);
    }
    levels += level / count;
    danced += sampled / count;
    squares += level.square() / count;
    products += level * sampled / count;
  }
  response.slope = (products - levels * danced) / (squares - levels.square());
  response.offset = danced - response.slope.array() * levels;
  return response;
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
    if (!inputs || !request.turn_to_key) continue;
    const Eigen::Vector3d shorter = TurnPrior::ShorterTurn(request);
    turns.push_back({*inputs, NearerWayRound(shorter, *request.turn_to_key) != shorter});
  }
  // Logistic regression by Newton's method, with slight shrinkage towards zero.
  TurnPrior prior;
  for (int round = 0; round < kNewtonRounds && turns.size() >= kMinTurnWindows; ++round) {
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
  return {Eigen::MatrixXd(correlation.llt().matrixL()), FillUnusedSpread(spread, kStill)};
}

}  // namespace choreo
