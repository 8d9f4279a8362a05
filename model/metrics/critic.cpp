#include "model/metrics/critic.h"

#include <algorithm>
#include <cmath>

#include "model/core/numbers/random.h"
#include "model/metrics/linear.h"
#include "model/metrics/speed_spectrum.h"

namespace choreo {
namespace {

constexpr size_t kFolds = 5, kDeals = 5;
constexpr double kStill = 0.005;  // m/s
constexpr uint64_t kSeed = 24;

// Extends features [features, windows] by fixed random rectified projections, which can express
// "too slow or too fast".
class Lift {
 public:
  Lift(Eigen::Index features, int projections)
      : weights_(projections, features), biases_(projections) {
    Random random(kSeed);
    const double scale = 1 / std::sqrt(static_cast<double>(features));
    for (double& weight : weights_.reshaped()) weight = scale * random.Normal();
    for (double& bias : biases_) bias = 0.5 * random.Normal();
  }

  Eigen::MatrixXd operator()(const Eigen::MatrixXd& features) const {
    Eigen::MatrixXd lifted(features.rows() + weights_.rows(), features.cols());
    lifted.topRows(features.rows()) = features;
    lifted.bottomRows(weights_.rows()) = ((weights_ * features).colwise() + biases_).cwiseMax(0);
    return lifted;
  }

 private:
  Eigen::MatrixXd weights_;
  Eigen::VectorXd biases_;
};

// Scales rows to mean 0 and deviation 1 over the windows that it was made from.
struct Scale {
  Eigen::VectorXd mean, over_deviation;

  explicit Scale(const Eigen::MatrixXd& features) : mean(features.rowwise().mean()) {
    const Eigen::VectorXd variance =
        (features.colwise() - mean).rowwise().squaredNorm() / static_cast<double>(features.cols());
    over_deviation = (variance.array() + 1e-12).rsqrt();
  }
  Eigen::MatrixXd Apply(const Eigen::MatrixXd& features) const {
    return over_deviation.asDiagonal() * (features.colwise() - mean);
  }
};

// The windows of clips in the fold, or of all other clips.
Eigen::MatrixXd Gather(const CriticWindows& windows, size_t fold, bool of_fold) {
  std::vector<Eigen::VectorXd> chosen;
  for (size_t i = 0; i < windows.clips.size(); ++i) {
    if ((windows.clips[i] % kFolds == fold) == of_fold) chosen.push_back(windows.features[i]);
  }
  return SideBySide(chosen);
}

// Fits the direction from real to danced windows. Both kinds have equal weight.
Eigen::VectorXd Learn(const Eigen::MatrixXd& features, Eigen::Index real) {
  const auto count = static_cast<double>(features.cols());
  const Eigen::Index danced = features.cols() - real;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(features.rows(), features.rows());
  covariance.selfadjointView<Eigen::Lower>().rankUpdate(features, 1 / count);
  const Eigen::VectorXd apart =
      features.rightCols(danced).rowwise().mean() - features.leftCols(real).rowwise().mean();
  return SolveRidge(covariance, apart);
}

// The critic's features of a window: logarithms of SpeedSpectrum and of each joint's least and
// greatest speed. Speeds below kStill look still and count as kStill.
Eigen::VectorXd CriticFeatures(const JointTrack& track, double fps) {
  const Eigen::MatrixXd power = SpeedSpectrum(track, fps);
  const Eigen::Index joints = track[0].cols();
  Eigen::ArrayXXd speeds(track.size() - 1, joints);  // one step per row
  for (size_t t = 1; t < track.size(); ++t)
    speeds.row(t - 1) = (track[t] - track[t - 1]).colwise().norm().array() * fps;
  Eigen::Array2Xd extremes(2, joints);
  extremes << speeds.colwise().minCoeff(), speeds.colwise().maxCoeff();
  Eigen::VectorXd features(power.size() + extremes.size());
  features << (power.array() + kStill * kStill).log().reshaped(),
      (extremes + kStill).log().reshaped();
  return features;
}

}  // namespace

void CriticWindows::Add(const JointTrack& track, double fps, size_t clip) {
  const auto length = static_cast<std::ptrdiff_t>(std::lround(fps));
  for (auto from = track.begin(); track.end() - from >= length; from += length) {
    features.push_back(CriticFeatures(JointTrack(from, from + length), fps));
    clips.push_back(clip);
  }
}

double AreaUnderCurve(const std::vector<double>& high, const std::vector<double>& low) {
  if (high.empty() || low.empty()) return NAN;
  std::vector<double> sorted = low;
  std::ranges::sort(sorted);
  double above = 0;
  for (const double value : high) {
    const auto [first, last] = std::ranges::equal_range(sorted, value);
    above += static_cast<double>(first - sorted.begin()) + 0.5 * static_cast<double>(last - first);
  }
  return above / (static_cast<double>(high.size()) * low.size());
}

double CriticArea(const CriticWindows& real, const CriticWindows& danced, int projections) {
  double sum = 0, weights = 0;
  for (size_t fold = 0; fold < kFolds; ++fold) {
    const Eigen::MatrixXd seen_real = Gather(real, fold, false);
    const Eigen::MatrixXd seen_danced = Gather(danced, fold, false);
    const Eigen::MatrixXd judged_real = Gather(real, fold, true);
    const Eigen::MatrixXd judged_danced = Gather(danced, fold, true);
    if (seen_real.cols() == 0 || seen_danced.cols() == 0 || judged_real.cols() == 0 ||
        judged_danced.cols() == 0)
      continue;
    const Eigen::MatrixXd seen = SideBySide<Eigen::MatrixXd>({seen_real, seen_danced});
    const Scale scale(seen);
    const Lift lift(seen.rows(), projections);
    const Eigen::MatrixXd lifted = lift(scale.Apply(seen));
    const Scale again(lifted);
    const Eigen::VectorXd direction = Learn(again.Apply(lifted), seen_real.cols());
    const auto scores = [&](const Eigen::MatrixXd& features) {
      const Eigen::VectorXd judged =
          again.Apply(lift(scale.Apply(features))).transpose() * direction;
      return std::vector<double>(judged.begin(), judged.end());
    };
    const auto weight = static_cast<double>(judged_real.cols() + judged_danced.cols());
    sum += weight * AreaUnderCurve(scores(judged_danced), scores(judged_real));
    weights += weight;
  }
  return weights > 0 ? sum / weights : NAN;
}

double RealAgainstReal(const CriticWindows& real) {
  double sum = 0;
  Random random(kSeed, /*stream=*/1);
  for (size_t deal = 0; deal < kDeals; ++deal) {
    CriticWindows sides[2];
    // Windows are in clip order. Each pair of neighbours is split between the sides.
    for (size_t i = 0; i + 1 < real.clips.size(); i += 2) {
      const size_t first = random.Next() % 2;
      for (size_t which = 0; which < 2; ++which) {
        CriticWindows& side = sides[(first + which) % 2];
        side.features.push_back(real.features[i + which]);
        side.clips.push_back(real.clips[i + which]);
      }
    }
    sum += CriticArea(sides[0], sides[1]);
  }
  return sum / kDeals;
}

}  // namespace choreo
