#include "model/fit/solver/fit_problem.h"

#include <algorithm>
#include <cmath>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

// Damping grows with each rejected step. Beyond the maximum, steps are too short to matter.
constexpr double kFirstDamping = 1e-4;
constexpr double kMaxDamping = 1e2;

// Weight of the parent's rotation relative to landmarks in Start, square metres.
constexpr double kStays = 1e-4, kTrunkStays = 0.02;

}  // namespace

FitProblem::FitProblem(const Skeleton& skeleton, const SourceMapping& mapping,
                       const FitOptions& options, double fps)
    : skeleton_(skeleton),
      marks_(skeleton, mapping),
      landmark_term_(skeleton_, marks_, mapping.accuracy_m),
      hinge_term_(skeleton_, marks_),
      joint_term_(skeleton_, options, fps) {
  const int unknowns = 3 + 3 * skeleton_.joints();
  const int rows = 3 * marks_.size() + hinge_term_.rows();
  rows_.jacobian.setZero(rows, unknowns);
  rows_.residual.resize(rows);
  normal_.resize(unknowns, unknowns);
  Place(RestPose(skeleton_));
  rest_ = places_;
}

void FitProblem::Place(const Pose& pose) {
  ForwardKinematics(skeleton_, pose, places_.joints);
  places_.marks = marks_.Positions(places_.joints);
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

// Requires that Cost has run on this pose.
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
  // The priors assume angles up to pi.
  for (int joint = 0; joint < skeleton_.joints(); ++joint) {
    pose.rotations.col(joint) = ExpFromQuaternion(QuaternionFromExp(pose.rotations.col(joint)));
  }
  hinge_term_.Aim(targets);
  trial_ = pose;
  double cost = Cost(targets, neighbours, pose);
  double damping = kFirstDamping;
  bool relinearise = true;
  for (int taken = 0; taken < iterations && damping < kMaxDamping; taken += relinearise ? 1 : 0) {
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
      // A linearisation is valid for a fraction of a turn.
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
  // The last trial may have been rejected.
  Place(pose);
  double squares = 0, weights = 0;
  for (int i = 0; i < marks_.size(); ++i) {
    squares += marks_[i].weight * (places_.marks.col(i) - targets.col(i)).squaredNorm();
    weights += marks_[i].weight;
  }
  return std::sqrt(squares / weights);
}

bool FitProblem::InTrunk(int joint) const {
  return joint > 0 && IsBelow(skeleton_.left_shoulder, joint, skeleton_.parents) &&
         IsBelow(skeleton_.right_shoulder, joint, skeleton_.parents);
}

double FitProblem::TrunkTurn(const Pose& pose) const {
  double turn = 0;
  for (int joint = 1; joint < skeleton_.joints(); ++joint) {
    if (InTrunk(joint)) turn += pose.rotations.col(joint).norm();
  }
  return turn;
}

Pose FitProblem::Start(const Eigen::Matrix3Xd& targets) const {
  const int joints = skeleton_.joints();
  Pose pose;
  pose.rotations.setZero(3, joints);
  Eigen::Matrix3Xd places(3, joints);
  std::vector<Eigen::Matrix3d> turns(joints, Eigen::Matrix3d::Identity());
  std::vector<char> below(marks_.size());
  for (int joint = 0; joint < joints; ++joint) {
    const int parent = skeleton_.parents[joint];
    // The root turns about the root landmark, whose position is known; other joints turn about
    // themselves.
    Eigen::Vector3d pivot_target = targets.col(0), pivot_rest = rest_.marks.col(0);
    if (parent >= 0) {
      places.col(joint) = places.col(parent) + turns[parent] * skeleton_.offsets.col(joint);
      pivot_target = places.col(joint);
      pivot_rest = rest_.joints.positions.col(joint);
    }
    for (int i = 0; i < marks_.size(); ++i) {
      below[i] = (parent >= 0 || i > 0) &&
                 std::ranges::all_of(marks_[i].points, [&](const LandmarkSet::Point& point) {
                   return IsBelow(point.joint, joint, skeleton_.parents) &&
                          (point.joint != joint || !point.offset.isZero());
                 });
    }
    // Without evidence, the joint keeps its parent's rotation. The trunk's landmarks are nearly
    // collinear and do not determine its twist. By their noise a start could be twisted by a whole
    // turn and stay so, with hips and shoulders in place.
    const Eigen::Matrix3d carried = parent < 0 ? Eigen::Matrix3d::Identity() : turns[parent];
    Eigen::Matrix3d correlation = (InTrunk(joint) ? kTrunkStays : kStays) * carried;
    bool has_evidence = false;
    for (int i = 0; i < marks_.size(); ++i) {
      if (!below[i] || (marks_[i].parent >= 0 && below[marks_[i].parent])) continue;
      has_evidence = true;
      correlation += marks_[i].weight * (targets.col(i) - pivot_target) *
                     (rest_.marks.col(i) - pivot_rest).transpose();
    }
    for (const HingePlane& hinge : hinge_term_.planes()) {
      if (hinge.upper_joint != joint) continue;
      const Eigen::Vector3d upper = (targets.col(hinge.hinge_mark) - pivot_target).normalized();
      const Eigen::Vector3d lower =
          (targets.col(hinge.end_mark) - targets.col(hinge.hinge_mark)).normalized();
      const Eigen::Vector3d plane = upper.cross(lower);
      // If a nearly straight limb seems to bend backwards, its plane is noise.
      const bool plausible = plane.norm() > kSineOfSureBend || plane.dot(carried * hinge.axis) > 0;
      if (plausible) correlation += 0.05 * plane * hinge.axis.transpose();
    }
    turns[joint] = has_evidence ? NearestRotation(correlation) : carried;
    if (parent < 0) {
      places.col(0) =
          targets.col(0) - turns[0] * (rest_.marks.col(0) - rest_.joints.positions.col(0));
      pose.root_position = places.col(0);
    }
    pose.rotations.col(joint) = LogMap(carried.transpose() * turns[joint]);
  }
  return pose;
}

}  // namespace choreo
