#include "model/fit/fit_problem.h"

#include <algorithm>
#include <cmath>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kHingePlane = 0.2;  // radians of a hinge's axis from the plane of a bent limb
// Damping grows with each step that is refused; beyond the most, steps are too short to matter.
constexpr double kFirstDamping = 1e-4;
constexpr double kMostDamping = 1e2;

}  // namespace

FitProblem::FitProblem(const Skeleton& skeleton, const SourceMapping& mapping,
                       const FitOptions& options, double fps)
    : skeleton_(skeleton),
      marks_(skeleton, mapping),
      landmark_term_(skeleton_, marks_, mapping.accuracy_m),
      hinge_term_(skeleton_, marks_, kHingePlane),
      joint_term_(skeleton_, options, fps),
      start_(skeleton_, marks_, hinge_term_.planes()) {
  const int unknowns = 3 + 3 * skeleton_.joints();
  const int rows = 3 * marks_.size() + hinge_term_.rows();
  rows_.jacobian.setZero(rows, unknowns);
  rows_.residual.resize(rows);
  normal_.resize(unknowns, unknowns);
  damped_.resize(unknowns, unknowns);
  gradient_.resize(unknowns);
  step_.resize(unknowns);
  cholesky_ = Eigen::LLT<Eigen::MatrixXd>(unknowns);
}

void FitProblem::Place(const Pose& pose) {
  ForwardKinematics(skeleton_, pose, places_.joints);
  marks_.Positions(places_.joints, places_.marks);
}

double FitProblem::Cost(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours,
                        const Pose& pose) {
  Place(pose);
  double cost = 0;
  landmark_term_.AddCost(places_, targets, &cost);
  hinge_term_.AddCost(places_, &cost);
  joint_term_.AddCost(pose, neighbours, &cost);
  return cost;
}

// Assumes that Cost ran on this pose.
void FitProblem::Linearise(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours,
                           const Pose& pose) {
  rows_.jacobian.setZero();
  landmark_term_.Linearise(places_, targets, &rows_);
  hinge_term_.Linearise(places_, &rows_);
  normal_.setZero();
  normal_.selfadjointView<Eigen::Lower>().rankUpdate(rows_.jacobian.transpose());
  gradient_.noalias() = rows_.jacobian.transpose() * rows_.residual;
  joint_term_.Linearise(pose, neighbours, &normal_, &gradient_);
}

double FitProblem::Solve(const Eigen::Matrix3Xd& targets, const FitNeighbours& neighbours,
                         int iterations, Pose& pose) {
  // The priors are about angles up to pi.
  for (int joint = 0; joint < skeleton_.joints(); ++joint) {
    pose.rotations.col(joint) = ExpFromQuaternion(QuaternionFromExp(pose.rotations.col(joint)));
  }
  hinge_term_.Aim(targets);
  trial_ = pose;
  double cost = Cost(targets, neighbours, pose);
  double damping = kFirstDamping;
  bool relinearise = true;
  for (int taken = 0; taken < iterations && damping < kMostDamping; taken += relinearise ? 1 : 0) {
    if (relinearise) Linearise(targets, neighbours, pose);
    damped_ = normal_;
    damped_.diagonal() *= 1.0 + damping;
    damped_.diagonal().array() += 1e-3;
    cholesky_.compute(damped_);
    step_ = -gradient_;
    cholesky_.solveInPlace(step_);
    trial_.root_position = pose.root_position + step_.head<3>();
    for (int joint = 0; joint < skeleton_.joints(); ++joint) {
      Eigen::Vector3d turn = step_.segment<3>(3 + 3 * joint);
      // A linearisation holds for a fraction of a turn.
      if (const double angle = turn.norm(); angle > 0.7) turn *= 0.7 / angle;
      trial_.rotations.col(joint) =
          ExpFromQuaternion(QuaternionFromExp(turn) * QuaternionFromExp(pose.rotations.col(joint)));
    }
    const double trial_cost = Cost(targets, neighbours, trial_);
    relinearise = trial_cost < cost;
    if (relinearise) {
      const bool done = cost - trial_cost < 1e-9 * cost;
      std::swap(pose, trial_);
      cost = trial_cost;
      damping = std::max(1e-7, damping * 0.1);
      if (done) break;
    } else {
      damping *= 20.0;
    }
  }
  // The last trial may have been refused.
  Place(pose);
  double squares = 0, weights = 0;
  for (int i = 0; i < marks_.size(); ++i) {
    squares += marks_[i].weight * (places_.marks.col(i) - targets.col(i)).squaredNorm();
    weights += marks_[i].weight;
  }
  return std::sqrt(squares / weights);
}

}  // namespace choreo
