#include "model/flow/priors/motion_prior.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <list>
#include <map>
#include <string>

#include "model/core/error.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

// Shares of the velocity's variance: the assumed error of a history (which may be a model's), and a
// jitter that keeps covariances invertible.
constexpr double kHistoryDoubt = 0.01, kJitter = 1e-6;
constexpr double kStillness = 2e-4;  // per frame; slower dimensions don't move
constexpr double kMinScale = 0.5, kMaxAsked = 4;
constexpr double kMinEnergy = 1e-3;        // metres a frame
constexpr int kStaged = -1, kFacing = -2;  // stand for "no key, staged" in cache keys
constexpr size_t kKept = 96;               // cached bridges; one of 96 frames takes 3 MB

}  // namespace

struct MotionPrior::Cache {
  using Key = std::pair<int, int>;
  using Value = std::shared_ptr<const std::vector<Bridge>>;
  std::mutex mutex;
  std::map<Key, Value> bridges;
  std::list<Key> order;  // oldest first
};

double UsualPose::Deviation(const Pose& other) const {
  if (pose.rotations.cols() == 0 || variance.size() == 0) return 0;
  const Pose local = GroundFrame::Of(other).ToLocal(other);
  const Eigen::Vector3d turn = RotationDifference(pose.rotations.col(0), local.rotations.col(0));
  const Eigen::Array3d off(local.root_position.y() - pose.root_position.y(), turn.x(), turn.z());
  const Eigen::Array3d usual(variance[1], variance[3], variance[5]);
  return (off.square() / usual.max(1e-9)).sqrt().maxCoeff();
}

MotionPrior::MotionPrior(Eigen::MatrixXd covariance, VariancePowers powers, UsualPose usual)
    : covariance_(std::move(covariance)),
      powers_(std::move(powers)),
      usual_(std::move(usual)),
      cache_(std::make_shared<Cache>()) {
  if (covariance_.cols() < 1 || !covariance_.allFinite() || covariance_.col(0).minCoeff() <= 0) {
    throw InvalidArgument("velocity_covariance", "is not a covariance of a process in time");
  }
  for (int d = 0; d < dimensions(); ++d) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(covariance_.cols());
    for (Eigen::Index lag = 1; lag < sums.size(); ++lag)
      sums[lag] = sums[lag - 1] + covariance_(d, lag);
    sums_.push_back(sums);
  }
}

double EnergyLevel(double factor, double median) {
  return std::log((factor + kMinEnergy) / (median + kMinEnergy));
}

double EnergyFactor(double level, double median) {
  return std::max(0.0, std::exp(level) * (median + kMinEnergy) - kMinEnergy);
}

Eigen::VectorXd FillUnusedSpread(Eigen::VectorXd spread, double still) {
  const auto turns = spread.tail(spread.size() - 3).array();
  const auto moves = (turns > still).cast<double>().eval();
  const double mean = (turns * moves).sum() / std::max(1.0, moves.sum());
  spread.tail(spread.size() - 3) = (turns > still).select(turns, std::max(mean, still));
  return spread;
}

Eigen::VectorXd MotionPrior::VelocitySpread() const {
  return FillUnusedSpread(covariance_.col(0).cwiseSqrt(), kStillness);
}

bool MotionPrior::Moves(int dimension) const {
  return covariance_(dimension, 0) > kStillness * kStillness;
}

Eigen::MatrixXd MotionPrior::Scales(double surprise, const Eigen::MatrixXd& levels) const {
  const VariancePowers& by = powers_;
  const double log_surprise = std::log(std::clamp(surprise, by.least, by.most));
  const auto scale = [](double log_variance, double least, double most) {
    return std::clamp(std::exp(0.5 * log_variance), least, most);
  };
  Eigen::MatrixXd scales = Eigen::MatrixXd::Constant(
      dimensions(), levels.cols(), scale(by.surprise * log_surprise, kMinScale, 1 / kMinScale));
  for (Eigen::Index i = 0; i < levels.cols(); ++i) {
    const Eigen::VectorXd asked = levels.col(i).unaryExpr([&](double level) {
      return scale(by.offset + by.known_surprise * log_surprise + by.level * level, by.least_scale,
                   kMaxAsked);
    });
    for (size_t d = 0; d < by.parts.size(); ++d) {
      const int part = by.parts[d];
      if (part >= 0 && !std::isnan(levels(part, i)))
        scales(static_cast<Eigen::Index>(d), i) = asked[part];
    }
  }
  return scales;
}

MotionPrior::Bridge MotionPrior::Make(int dimension, int frames, int to_key, double usual_variance,
                                      double doubt) const {
  const Eigen::Index lags = covariance_.cols();
  const auto velocity = [&](int lag) { return lag < lags ? covariance_(dimension, lag) : 0.0; };
  const auto sum = [&](int lag) {  // over lags 1 to `lag`
    return sums_[static_cast<size_t>(dimension)][std::min<Eigen::Index>(lag, lags - 1)];
  };
  const int longest = std::max({frames, to_key, kPast});
  std::vector<double> variance(static_cast<size_t>(longest) + 1,
                               0.0);  // of the displacement over n frames
  for (int n = 1; n <= longest; ++n) {
    variance[static_cast<size_t>(n)] =
        variance[static_cast<size_t>(n) - 1] + velocity(0) + 2 * sum(n - 1);
  }
  const auto both = [&](int i, int j) {  // of displacements over i and over j frames
    const auto at = [&](int n) { return variance[static_cast<size_t>(n)]; };
    return 0.5 * (at(i) + at(j) - at(std::abs(i - j)));
  };
  // Covariance of the velocity p frames before the last and the displacement over i frames.
  const auto with_past = [&](int i, int p) { return sum(i + p) - sum(p); };

  const int known = kPast + (to_key > 0 || usual_variance > 0 ? 1 : 0);
  Eigen::MatrixXd observed(known, known), shared(frames, known), own(frames, frames);
  for (int p = 0; p < kPast; ++p) {
    for (int q = 0; q < kPast; ++q) observed(p, q) = velocity(std::abs(p - q));
    observed(p, p) += kHistoryDoubt * velocity(0);
    for (int i = 0; i < frames; ++i) shared(i, p) = with_past(i + 1, p);
  }
  if (to_key > 0) {
    for (int p = 0; p < kPast; ++p) observed(p, kPast) = observed(kPast, p) = with_past(to_key, p);
    observed(kPast, kPast) = both(to_key, to_key) + kJitter * velocity(0) + doubt;
    for (int i = 0; i < frames; ++i) shared(i, kPast) = both(i + 1, to_key);
  }
  if (usual_variance > 0) {
    // Motion is stationary about the usual pose: the way there covaries with the way of i frames by
    // half of its variance.
    const auto half = [&](int i) { return 0.5 * variance[static_cast<size_t>(i)]; };
    for (int p = 0; p < kPast; ++p) observed(p, kPast) = observed(kPast, p) = half(p) - half(p + 1);
    // A pose far from the usual one must not lead beyond it.
    observed(kPast, kPast) = std::max(usual_variance, half(longest));
    for (int i = 0; i < frames; ++i) shared(i, kPast) = half(i + 1);
  }
  for (int i = 0; i < frames; ++i) {
    for (int j = 0; j < frames; ++j) own(i, j) = both(i + 1, j + 1);
  }
  const Eigen::MatrixXd weights = observed.ldlt().solve(shared.transpose()).transpose();
  own -= weights * shared.transpose();
  own = 0.5 * (own + own.transpose()).eval();
  Bridge bridge{
      .past = weights.leftCols(kPast),
      .key = known > kPast ? Eigen::VectorXd(weights.col(kPast)) : Eigen::VectorXd::Zero(frames),
      .spread = {},
      .expected = observed.diagonal()};
  for (double jitter = kJitter;; jitter *= 10) {
    own.diagonal().array() += jitter * velocity(0);
    const Eigen::LLT<Eigen::MatrixXd> cholesky(own);
    if (cholesky.info() == Eigen::Success) {
      bridge.spread = Eigen::MatrixXd(cholesky.matrixL()).cast<float>();
      return bridge;
    }
    if (jitter > 1) throw InvalidArgument("velocity_covariance", "is not positive definite");
  }
}

MotionPrior::Made MotionPrior::Cached(std::pair<int, int> key,
                                      const std::function<std::vector<Bridge>()>& make) const {
  {
    const std::lock_guard lock(cache_->mutex);
    const auto found = cache_->bridges.find(key);
    if (found != cache_->bridges.end()) return found->second;
  }
  const auto made = std::make_shared<const std::vector<Bridge>>(make());
  const std::lock_guard lock(cache_->mutex);
  if (cache_->bridges.emplace(key, made).second) cache_->order.push_back(key);
  if (cache_->order.size() > kKept) {
    cache_->bridges.erase(cache_->order.front());
    cache_->order.pop_front();
  }
  return made;
}

MotionPrior::Made MotionPrior::Bridges(int frames, int to_key) const {
  return Cached({frames, to_key}, [&] {
    std::vector<Bridge> bridges;
    for (int d = 0; d < dimensions(); ++d) {
      // No position is usual except on a stage, and no facing is.
      const bool returns = to_key == 0 && d != 0 && d != 2 && d != kTurn;
      bridges.push_back(Make(d, frames, to_key, returns ? UsualVariance(d) : 0, 0));
    }
    return bridges;
  });
}

MotionPrior::Made MotionPrior::StageBridges(int frames) const {
  return Cached({frames, kStaged}, [&] {
    std::vector<Bridge> bridges;
    for (int d = 0; d < 3; ++d) bridges.push_back(Make(d, frames, 0, UsualVariance(d), 0));
    return bridges;
  });
}

std::shared_ptr<const MotionPrior::Bridge> MotionPrior::FacingBridge(int frames) const {
  const Made made = Cached({frames, kFacing}, [&] {
    return std::vector<Bridge>{Make(kTurn, frames, frames, 0, usual_.facing)};
  });
  return {made, made->data()};
}

}  // namespace choreo
