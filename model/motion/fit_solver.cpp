#include "model/motion/fit_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

// Knees and elbows: least bend that is asked for, and the most that a body allows.
constexpr double kLeastBend = 0.03;
constexpr double kMostBend = 2.7;
constexpr double kSineOfSureBend = 0.3;
// Radians that no hinge is bent backwards.
constexpr double kMostShortWay = 2;
// Damping grows with each step that is refused; beyond the most, steps are too short to matter.
constexpr double kFirstDamping = 1e-4;
constexpr double kMostDamping = 1e2;

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& w) {
  Eigen::Matrix3d k;
  k << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return k;
}

// d log(exp(delta) exp(w)) / d delta at delta = 0.
Eigen::Matrix3d LogJacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  const Eigen::Matrix3d k = CrossMatrix(w);
  const double square = angle * angle;
  // Series below the angle where the closed form cancels; the closed form has its pole at 2 pi,
  // away from [0, pi].
  const double factor = angle < 1e-3 ? 1.0 / 12.0 + square / 720.0
                                     : (1.0 - 0.5 * angle / std::tan(0.5 * angle)) / square;
  return Eigen::Matrix3d::Identity() - 0.5 * k + factor * k * k;
}

bool Contains(const std::string& name, std::initializer_list<const char*> parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&name](const char* part) { return name.find(part) != std::string::npos; });
}

double Square(double x) { return x * x; }

// A hinge that is bent far and turned about its limb as well is turned by more than half a turn:
// the shorter way round, on which it would be bent backwards, is not the way that it went.
Eigen::Vector3d AlongHinge(const Eigen::Vector3d& w, const Eigen::Vector3d& axis) {
  const double angle = w.norm();
  if (angle < kMostShortWay || axis.dot(w) >= 0) return w;
  return w * (1 - 2 * std::numbers::pi / angle);
}

// Inverse variances of a rotation vector with one deviation along an axis and another across it.
Eigen::Matrix3d AxisInformation(const Eigen::Vector3d& axis, double along_rad, double across_rad) {
  const Eigen::Vector3d unit = axis.normalized();
  const Eigen::Matrix3d along = unit * unit.transpose();
  return along / Square(along_rad) + (Eigen::Matrix3d::Identity() - along) / Square(across_rad);
}

}  // namespace

FitProblem::FitProblem(const Skeleton& skeleton, const SourceMapping& mapping,
                       const FitOptions& options, double fps)
    : skeleton_(skeleton),
      marks_(skeleton, mapping),
      options_(options),
      accuracy_m_(mapping.accuracy_m),
      change_information_(1.0 / Square(options.change_rad * 30.0 / fps)) {
  const int joints = skeleton_.joints();
  const JointPlacement rest = ForwardKinematics(skeleton_, RestPose(skeleton_));
  rest_joints_ = rest.positions;
  rest_marks_ = marks_.Positions(rest);
  priors_.resize(joints);
  for (int joint = 0; joint < joints; ++joint) {
    const bool stiff = Contains(skeleton_.joint_names[joint], {"spine", "collar", "neck", "head",
                                                               "wrist", "hand", "foot", "toe"});
    const double deviation = stiff ? options.stiff_rad : options.rest_rad;
    // The root may face anywhere.
    const double information = joint == 0 ? 0.0 : 1.0 / Square(deviation);
    priors_[joint].information = information * Eigen::Matrix3d::Identity();
    priors_[joint].hinge_axis.setZero();
  }
  for (const Hinge& hinge : Hinges(skeleton_)) SetHinge(hinge);
  for (const int ankle : {skeleton_.feet[0], skeleton_.feet[2]}) {
    if (ankle <= 0) continue;
    priors_[ankle].information =
        AxisInformation(skeleton_.offsets.col(ankle), options.foot_turn_rad, options.rest_rad);
  }
  const int unknowns = 3 + 3 * joints;
  const int rows = 3 * (marks_.size() + static_cast<int>(hinges_.size()));
  jacobian_.setZero(rows, unknowns);
  residual_.resize(rows);
  normal_.resize(unknowns, unknowns);
  damped_.resize(unknowns, unknowns);
  gradient_.resize(unknowns);
  step_.resize(unknowns);
  cholesky_ = Eigen::LLT<Eigen::MatrixXd>(unknowns);
}

void FitProblem::SetHinge(const Hinge& hinge) {
  JointPrior& prior = priors_[hinge.joint];
  prior.hinge_axis = hinge.axis;
  prior.information = AxisInformation(hinge.axis, options_.rest_rad, options_.hinge_side_rad);
  if (hinge.upper < 0) return;
  const int upper_mark = marks_.AtJoint(hinge.upper);
  const int hinge_mark = marks_.AtJoint(hinge.joint);
  for (int end = 0; end < marks_.size() && upper_mark >= 0 && hinge_mark >= 0; ++end) {
    if (marks_[end].parent != hinge_mark) continue;
    hinges_.push_back({.upper_joint = hinge.upper,
                       .upper_mark = upper_mark,
                       .hinge_mark = hinge_mark,
                       .end_mark = end,
                       .axis = prior.hinge_axis,
                       .normal = Eigen::Vector3d::Zero(),
                       .weight = 0});
    break;
  }
  priors_[hinge.upper].information =
      AxisInformation(skeleton_.offsets.col(hinge.joint), options_.twist_rad, options_.rest_rad);
}

void FitProblem::AimHinges(const Eigen::Matrix3Xd& targets) {
  for (HingePlane& hinge : hinges_) {
    const Eigen::Vector3d upper = targets.col(hinge.hinge_mark) - targets.col(hinge.upper_mark);
    const Eigen::Vector3d lower = targets.col(hinge.end_mark) - targets.col(hinge.hinge_mark);
    const Eigen::Vector3d normal = upper.cross(lower);
    const double sine = normal.norm() / std::max(1e-9, upper.norm() * lower.norm());
    // In a limb bent by less than the threshold the plane is noise, and may be that of a limb bent
    // backwards.
    const double sureness = std::max(0.0, sine - kSineOfSureBend) / (1.0 - kSineOfSureBend);
    hinge.weight = sureness / options_.hinge_plane_rad;
    if (sureness > 0) hinge.normal = normal.normalized();
  }
}

double FitProblem::Cost(const Eigen::Matrix3Xd& targets, const Neighbours& neighbours,
                        const Pose& pose) {
  ForwardKinematics(skeleton_, pose, placement_);
  marks_.Positions(placement_, positions_);
  const double position_information = 1.0 / Square(accuracy_m_);
  double cost = 0;
  for (int i = 0; i < marks_.size(); ++i) {
    cost += Square(marks_[i].weight) * position_information *
            (positions_.col(i) - targets.col(i)).squaredNorm();
  }
  for (const HingePlane& hinge : hinges_) {
    const Eigen::Vector3d axis = placement_.rotations[hinge.upper_joint] * hinge.axis;
    cost += Square(hinge.weight) * (axis - hinge.normal).squaredNorm();
  }
  for (int joint = 0; joint < skeleton_.joints(); ++joint) {
    const JointPrior& prior = priors_[joint];
    const Eigen::Vector3d w = AlongHinge(pose.rotations.col(joint), prior.hinge_axis);
    cost += w.dot(prior.information * w);
    if (!prior.hinge_axis.isZero()) {
      const double bend = prior.hinge_axis.dot(w);
      const double beyond = std::min(0.0, bend - kLeastBend) + std::max(0.0, bend - kMostBend);
      cost += Square(beyond / options_.hinge_limit_rad);
    }
    for (const Pose* other : {neighbours.before, neighbours.after}) {
      if (other == nullptr) continue;
      cost +=
          change_information_ * RotationDifference(other->rotations.col(joint), w).squaredNorm();
    }
  }
  return cost;
}

void FitProblem::AddPositionRows(const Eigen::Matrix3Xd& targets) {
  jacobian_.setZero();
  for (int i = 0; i < marks_.size(); ++i) {
    const LandmarkSet::Mark& mark = marks_[i];
    const double root_information = mark.weight / accuracy_m_;
    residual_.segment<3>(3 * i) = root_information * (positions_.col(i) - targets.col(i));
    jacobian_.block<3, 3>(3 * i, 0) = root_information * Eigen::Matrix3d::Identity();
    for (const LandmarkSet::Point& point : mark.points) {
      const Eigen::Vector3d place = LandmarkSet::Position(point, placement_);
      for (int joint = point.joint; joint >= 0; joint = skeleton_.parents[joint]) {
        const Eigen::Vector3d arm = place - placement_.positions.col(joint);
        // A rotation by omega (world) about the joint moves the point by omega x arm.
        const int parent = skeleton_.parents[joint];
        auto block = jacobian_.block<3, 3>(3 * i, 3 + 3 * joint);
        const Eigen::Matrix3d turned = -root_information * point.weight * CrossMatrix(arm);
        if (parent < 0) {
          block += turned;
        } else {
          block.noalias() += turned * placement_.rotations[parent];
        }
      }
    }
  }
}

void FitProblem::AddHingeRows() {
  for (size_t i = 0; i < hinges_.size(); ++i) {
    const HingePlane& hinge = hinges_[i];
    const auto row = static_cast<Eigen::Index>(3 * (marks_.size() + i));
    const Eigen::Vector3d axis = placement_.rotations[hinge.upper_joint] * hinge.axis;
    residual_.segment<3>(row) = hinge.weight * (axis - hinge.normal);
    const Eigen::Matrix3d turned = -hinge.weight * CrossMatrix(axis);
    for (int joint = hinge.upper_joint; joint >= 0; joint = skeleton_.parents[joint]) {
      const int parent = skeleton_.parents[joint];
      auto block = jacobian_.block<3, 3>(row, 3 + 3 * joint);
      if (parent < 0) {
        block = turned;
      } else {
        block.noalias() = turned * placement_.rotations[parent];
      }
    }
  }
}

// Assumes that Cost ran on this pose.
void FitProblem::Linearise(const Eigen::Matrix3Xd& targets, const Neighbours& neighbours,
                           const Pose& pose) {
  AddPositionRows(targets);
  AddHingeRows();
  normal_.setZero();
  normal_.selfadjointView<Eigen::Lower>().rankUpdate(jacobian_.transpose());
  gradient_.noalias() = jacobian_.transpose() * residual_;
  for (int joint = 0; joint < skeleton_.joints(); ++joint) {
    const JointPrior& prior = priors_[joint];
    const Eigen::Vector3d w = AlongHinge(pose.rotations.col(joint), prior.hinge_axis);
    const Eigen::Matrix3d slope = LogJacobian(w);
    Eigen::Matrix3d information = prior.information;
    Eigen::Vector3d pull = prior.information * w;
    if (!prior.hinge_axis.isZero()) {
      const double bend = prior.hinge_axis.dot(w);
      if (bend < kLeastBend || bend > kMostBend) {
        const double beyond = bend < kLeastBend ? bend - kLeastBend : bend - kMostBend;
        const double hard = 1.0 / Square(options_.hinge_limit_rad);
        information += hard * prior.hinge_axis * prior.hinge_axis.transpose();
        pull += hard * beyond * prior.hinge_axis;
      }
    }
    auto normal = normal_.block<3, 3>(3 + 3 * joint, 3 + 3 * joint);
    auto gradient = gradient_.segment<3>(3 + 3 * joint);
    normal += slope.transpose() * information * slope;
    gradient += slope.transpose() * pull;
    for (const Pose* other : {neighbours.before, neighbours.after}) {
      if (other == nullptr) continue;
      // log(R R_other^T), in the parent's frame as delta is; its own Jacobian is near identity.
      const Eigen::Vector3d change = ExpFromQuaternion(
          QuaternionFromExp(w) * QuaternionFromExp(other->rotations.col(joint)).conjugate());
      normal.diagonal().array() += change_information_;
      gradient += change_information_ * change;
    }
  }
}

double FitProblem::Solve(const Eigen::Matrix3Xd& targets, const Neighbours& neighbours,
                         int iterations, Pose& pose) {
  // The priors are about angles up to pi.
  for (int joint = 0; joint < skeleton_.joints(); ++joint) {
    pose.rotations.col(joint) = ExpFromQuaternion(QuaternionFromExp(pose.rotations.col(joint)));
  }
  AimHinges(targets);
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
  ForwardKinematics(skeleton_, pose, placement_);
  marks_.Positions(placement_, positions_);
  double squares = 0, weights = 0;
  for (int i = 0; i < marks_.size(); ++i) {
    squares += marks_[i].weight * (positions_.col(i) - targets.col(i)).squaredNorm();
    weights += marks_[i].weight;
  }
  return std::sqrt(squares / weights);
}

}  // namespace choreo
