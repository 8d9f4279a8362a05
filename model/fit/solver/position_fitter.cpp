#include "model/fit/solver/position_fitter.h"

#include <algorithm>
#include <utility>

#include "model/core/error.h"

namespace choreo {
namespace {

constexpr int kFirstIterations = 60;  // for a frame without a predecessor
// RMS landmark distance above which a warm start counts as lost, metres.
constexpr double kLostDistance = 0.04;
// The largest rotation of a trunk, radians. A trunk beyond it is wound up: hips and shoulders are
// in place, but a whole turn apart.
constexpr double kWoundTurn = 2.6;

}  // namespace

PositionFitter::PositionFitter(const Skeleton& skeleton, const SourceMapping& mapping,
                               const FitOptions& options, double fps)
    : problem_(std::make_unique<FitProblem>(skeleton, mapping, options, fps)), options_(options) {}

const Pose& PositionFitter::Next(const Eigen::Matrix3Xd& targets, const Pose* after) {
  const Eigen::Index landmarks = problem_->landmarks().cols();
  if (targets.cols() != landmarks || !targets.allFinite()) {
    throw InvalidArgument("targets", std::to_string(targets.cols()) + " landmarks, must be " +
                                         std::to_string(landmarks) + " and finite");
  }
  if (!pose_) {
    pose_ = problem_->Start(targets);
    problem_->Solve(targets, {}, kFirstIterations, *pose_);
    return *pose_;
  }
  const Pose previous = *pose_;
  const FitNeighbours neighbours = {.before = &previous, .after = after};
  const double distance = problem_->Solve(targets, neighbours, options_.iterations, *pose_);
  if (options_.recover && (distance > kLostDistance || problem_->TrunkTurn(*pose_) > kWoundTurn))
    Recover(targets, neighbours, distance);
  MakeContinuous(*pose_, previous);
  return *pose_;
}

// Tries again from scratch. Keeps the result only if it is much nearer, or as near and unwound,
// because even a clip that does not fit should be smooth.
void PositionFitter::Recover(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours,
                             double distance) {
  Pose fresh = problem_->Start(targets);
  const double again = problem_->Solve(targets, {}, kFirstIterations, fresh);
  const bool unwound = problem_->TrunkTurn(*pose_) > kWoundTurn &&
                       problem_->TrunkTurn(fresh) < kWoundTurn &&
                       again < std::max(distance, kLostDistance);
  if (again < 0.5 * distance || unwound) {
    pose_ = std::move(fresh);
  } else {
    problem_->Solve(targets, neighbours, options_.iterations, *pose_);
  }
}

}  // namespace choreo
