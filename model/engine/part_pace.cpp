#include "model/engine/part_pace.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace choreo {
namespace {

using Eigen::MatrixXd;

constexpr double kSpan = 20;  // frames; swings of 2 pi times that change by half
constexpr int kRounds = 3;    // a longer step is another direction, and another speed
constexpr double kMost = 3;   // times as long, or as short, as planned
// Of their mean, by how much factors vary whose rhythm is followed wholly; and by how much those
// of real dances do, which networks have learnt to answer.
constexpr double kRhythm = 0.2;
constexpr double kRealRhythm = 0.4;
// By how much a plan may be too slow, or too fast, for its factors not to be asked for again, and
// by how much more, or less, they are.
constexpr double kEnough = 1.1;
constexpr double kMostAgain = 2;
constexpr double kLeastFactor = 1e-4;  // metres a frame, below which nothing moves

// What minimises sum |x_t - x_{t-1}|^2 + sum |x_t|^2 / kSpan^2 - 2 sum x_t y_t over columns t, the
// neighbours before the first and behind the last column being zero where they are held there.
MatrixXd Solve(MatrixXd y, bool from_zero, bool to_zero) {
  const Eigen::Index count = y.cols();
  std::vector<double> above(static_cast<size_t>(count));
  for (Eigen::Index t = 0; t < count; ++t) {  // Thomas' algorithm
    double diagonal = 1 / (kSpan * kSpan);
    diagonal += t > 0 || from_zero ? 1 : 0;
    diagonal += t + 1 < count || to_zero ? 1 : 0;
    if (t > 0) {
      diagonal += above[static_cast<size_t>(t - 1)];
      y.col(t) += y.col(t - 1);
    }
    above[static_cast<size_t>(t)] = -1 / diagonal;
    y.col(t) /= diagonal;
  }
  for (Eigen::Index t = count - 2; t >= 0; --t)
    y.col(t) -= above[static_cast<size_t>(t)] * y.col(t + 1);
  return y;
}

VelocityFactorTrack Slow(const VelocityFactorTrack& factors) {
  return Solve(factors / (kSpan * kSpan), false, false);
}

MatrixXd Steps(const MatrixXd& positions) {
  const Eigen::Index frames = positions.cols() - 1;
  return positions.rightCols(frames) - positions.leftCols(frames);
}

VelocityFactorTrack Factors(const BodyPartWeights& weights, const MatrixXd& steps) {
  const MatrixXd squares = steps.array().square();
  MatrixXd speeds(weights.cols(), steps.cols());
  for (Eigen::Index joint = 0; joint < speeds.rows(); ++joint)
    speeds.row(joint) = squares.middleRows(3 * joint, 3).colwise().sum().cwiseSqrt();
  return (weights * speeds).array() + kLeastFactor;
}

// Factors, and how they are told apart: what they ask for on the whole, and when.
class Wanted {
 public:
  Wanted(const BodyPartWeights& weights, const VelocityFactorTrack& factors)
      : weights_(weights), frames_(factors.array() + kLeastFactor), level_(Slow(frames_)) {
    varies_ = (frames_.array() / level_.array() - 1).abs().rowwise().mean();
  }

  // 0, such as of a constant, to 1 for factors that vary by `whole` of their mean.
  double Rhythm(int part, double whole) const { return std::min(1.0, varies_[part] / whole); }

  // How many times as fast each part should be: over some frames, [5, N].
  VelocityFactorTrack OnTheWhole(const MatrixXd& steps) const {
    return level_.cwiseQuotient(Slow(Factors(weights_, steps)));
  }
  // In each frame, as far as the factors have a rhythm.
  VelocityFactorTrack InEachFrame(const MatrixXd& steps) const {
    const VelocityFactorTrack whole = OnTheWhole(steps),
                              frame = frames_.cwiseQuotient(Factors(weights_, steps));
    VelocityFactorTrack times(kBodyParts, steps.cols());
    for (int part = 0; part < kBodyParts; ++part) {
      const double rhythm = Rhythm(part, kRhythm);
      times.row(part) =
          whole.row(part).array().pow(1 - rhythm) * frame.row(part).array().pow(rhythm);
    }
    return times;
  }

 private:
  const BodyPartWeights weights_;
  VelocityFactorTrack frames_, level_;
  Eigen::ArrayXd varies_;  // by how much of their mean, each part's
};

}  // namespace

VelocityFactorTrack AskAgain(const BodyPartWeights& weights, const VelocityFactorTrack& factors,
                             const MatrixXd& planned) {
  const Wanted wanted(weights, factors);
  const VelocityFactorTrack times = wanted.OnTheWhole(Steps(planned));
  // 1 within what is enough.
  VelocityFactorTrack again =
      (times / kEnough).cwiseMax(1).cwiseProduct((times * kEnough).cwiseMin(1));
  again = again.cwiseMax(1 / kMostAgain).cwiseMin(kMostAgain);
  for (int part = 0; part < kBodyParts; ++part)
    again.row(part) = again.row(part).array().pow(1 - wanted.Rhythm(part, kRealRhythm));
  return factors.cwiseProduct(again);
}

MatrixXd PaceParts(const BodyPartWeights& weights, const VelocityFactorTrack& factors,
                   const MatrixXd& planned, bool held) {
  const Eigen::Index frames = factors.cols(), free = held ? frames - 1 : frames;
  const Wanted wanted(weights, factors);
  const MatrixXd planned_steps = Steps(planned);
  MatrixXd paced = planned;
  VelocityFactorTrack times = VelocityFactorTrack::Ones(kBodyParts, frames);
  for (int round = 0; round < kRounds && free > 0; ++round) {
    times =
        times.cwiseProduct(wanted.InEachFrame(Steps(paced))).cwiseMax(1 / kMost).cwiseMin(kMost);
    MatrixXd lack = MatrixXd::Zero(planned.rows(), frames);
    for (Eigen::Index joint = 1; joint < weights.cols(); ++joint) {
      Eigen::Index part = 0;  // a joint is of one
      weights.col(joint).maxCoeff(&part);
      lack.middleRows(3 * joint, 3) =
          planned_steps.middleRows(3 * joint, 3).array().rowwise() * (times.row(part).array() - 1);
    }
    // Displacements e of the plan, e_0 = 0, that minimise sum |e_t - e_{t-1} - lack_t|^2 +
    // sum |e_t|^2 / kSpan^2.
    MatrixXd pull = lack.leftCols(free);
    const Eigen::Index followed = std::min(free, frames - 1);
    pull.leftCols(followed) -= lack.middleCols(1, followed);
    paced.middleCols(1, free) = planned.middleCols(1, free) + Solve(pull, true, held);
  }
  return paced;
}

}  // namespace choreo
