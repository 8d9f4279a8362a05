#include "model/fit/position_fitter.h"

#include <algorithm>
#include <utility>

#include "model/core/error.h"
#include "model/fit/fit_problem.h"

namespace choreo {
namespace {

constexpr int kFirstIterations = 60;  // of a frame without a predecessor
// Root mean square distance of the landmarks at which a warm start is taken for lost.
constexpr double kLostDistance = 0.04;
// Radians that no trunk turns. One that does is wound up: hips and shoulders are where they belong,
// a whole turn apart.
constexpr double kWoundTurn = 2.6;

}  // namespace

PositionFitter::PositionFitter(const Skeleton& skeleton, const SourceMapping& mapping,
                               const FitOptions& options, double fps)
    : problem_(std::make_unique<FitProblem>(skeleton, mapping, options, fps)), options_(options) {}
PositionFitter::~PositionFitter() = default;
PositionFitter::PositionFitter(PositionFitter&&) noexcept = default;
PositionFitter& PositionFitter::operator=(PositionFitter&&) noexcept = default;

const Pose& PositionFitter::Next(const Eigen::Matrix3Xd& targets, const Pose* after) {
  if (targets.cols() != problem_->landmarks_count() || !targets.allFinite()) {
    throw InvalidArgument("targets", std::to_string(targets.cols()) + " landmarks, must be " +
                                         std::to_string(problem_->landmarks_count()) +
                                         " and finite");
  }
  if (!has_previous_) {
    problem_->Start(targets, pose_);
    problem_->Solve(targets, {}, kFirstIterations, pose_);
  } else {
    previous_ = pose_;
    const FitNeighbours neighbours = {.before = &previous_, .after = after};
    const double distance = problem_->Solve(targets, neighbours, options_.iterations, pose_);
    if (options_.recover && (distance > kLostDistance || problem_->TrunkTurn(pose_) > kWoundTurn)) {
      Recover(targets, neighbours, distance);
    }
    MakeContinuous(pose_, previous_);
  }
  has_previous_ = true;
  return pose_;
}

// Tries again from scratch, and keeps that only where it is much nearer, or as near and unwound: a
// clip that does not fit at all should at least be smooth.
void PositionFitter::Recover(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours,
                             double distance) {
  problem_->Start(targets, fresh_);
  const double again = problem_->Solve(targets, {}, kFirstIterations, fresh_);
  const bool unwound = problem_->TrunkTurn(pose_) > kWoundTurn &&
                       problem_->TrunkTurn(fresh_) < kWoundTurn &&
                       again < std::max(distance, kLostDistance);
  if (again < 0.5 * distance || unwound) {
    std::swap(pose_, fresh_);
  } else {
    problem_->Solve(targets, neighbours, options_.iterations, pose_);
  }
}

void PositionFitter::Reset(const Pose& previous) {
  pose_ = previous;
  has_previous_ = true;
}

}  // namespace choreo
