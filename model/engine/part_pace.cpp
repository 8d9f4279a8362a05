#include "model/engine/part_pace.h"

#include <algorithm>
#include <vector>

namespace choreo {
namespace {

using Eigen::MatrixXd;

constexpr double kSpan = 20;  // frames: what is slower than that stays where it was
constexpr int kRounds = 3;    // a longer step is another direction, and another speed
constexpr double kMost = 2;   // times as long, or as short, as in the round before
// Of their mean, by how much factors must vary to count as a rhythm.
constexpr double kRhythm = 0.1;
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

// By how many times each part is too slow in each frame.
class Lack {
 public:
  Lack(const BodyPartWeights& weights, const VelocityFactorTrack& factors)
      : weights_(weights), wanted_(factors.array() + kLeastFactor), level_(Slow(wanted_)) {
    has_rhythm_ = (wanted_.array() / level_.array() - 1).abs().rowwise().mean() > kRhythm;
  }

  VelocityFactorTrack Of(const MatrixXd& steps) const {
    const VelocityFactorTrack danced = Factors(weights_, steps), danced_level = Slow(danced);
    VelocityFactorTrack times(kBodyParts, steps.cols());
    for (int part = 0; part < kBodyParts; ++part) {
      times.row(part) = has_rhythm_[part] ? wanted_.row(part).cwiseQuotient(danced.row(part))
                                          : level_.row(part).cwiseQuotient(danced_level.row(part));
    }
    return times.cwiseMax(1 / kMost).cwiseMin(kMost);
  }
  bool has_rhythm(int part) const { return has_rhythm_[part]; }

 private:
  const BodyPartWeights& weights_;
  VelocityFactorTrack wanted_, level_;
  Eigen::Array<bool, kBodyParts, 1> has_rhythm_;
};

}  // namespace

VelocityFactorTrack AskAgain(const BodyPartWeights& weights, const VelocityFactorTrack& factors,
                             const MatrixXd& planned) {
  const Lack lack(weights, factors);
  const VelocityFactorTrack times = lack.Of(Steps(planned));
  VelocityFactorTrack asked = factors;
  for (int part = 0; part < kBodyParts; ++part) {
    if (!lack.has_rhythm(part)) asked.row(part).array() *= times.row(part).array();
  }
  return asked;
}

MatrixXd PaceParts(const BodyPartWeights& weights, const VelocityFactorTrack& factors,
                   const MatrixXd& planned, bool held) {
  const Eigen::Index frames = factors.cols(), free = held ? frames - 1 : frames;
  const Lack lack(weights, factors);
  const MatrixXd planned_steps = Steps(planned);
  MatrixXd paced = planned;
  for (int round = 0; round < kRounds && free > 0; ++round) {
    MatrixXd steps = Steps(paced);
    // A joint is of one part: its share there is all that it has.
    const VelocityFactorTrack times = lack.Of(steps);
    for (Eigen::Index joint = 1; joint < weights.cols(); ++joint) {
      Eigen::Index part = 0;
      weights.col(joint).maxCoeff(&part);
      steps.middleRows(3 * joint, 3).array().rowwise() *= times.row(part).array();
    }
    // Displacements e of the plan, e_0 = 0, that minimise sum |e_t - e_{t-1} - g_t|^2 +
    // sum |e_t|^2 / kSpan^2, where the g are what its steps lack.
    steps -= planned_steps;
    MatrixXd pull = steps.leftCols(free);
    const Eigen::Index followed = std::min(free, frames - 1);
    pull.leftCols(followed) -= steps.middleCols(1, followed);
    paced.middleCols(1, free) = planned.middleCols(1, free) + Solve(pull, true, held);
  }
  return paced;
}

}  // namespace choreo
