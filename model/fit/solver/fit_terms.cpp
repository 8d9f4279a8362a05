#include "model/fit/solver/fit_terms.h"

#include <algorithm>
#include <cmath>

#include "model/core/grid.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kHingePlane =
    0.2;  // radians between a hinge's axis and the normal of the bent limb's plane
constexpr double kMinBend = 0.03;  // radians, of knees and elbows
// Radians: no hinge bends backwards this far.
constexpr double kMaxShortTurn = 2;

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

// Inverse variances of a rotation vector with one deviation along an axis and another across it.
Eigen::Matrix3d AxisInformation(const Eigen::Vector3d& axis, double along_rad, double across_rad) {
  const Eigen::Vector3d unit = axis.normalized();
  const Eigen::Matrix3d along = unit * unit.transpose();
  return along / Square(along_rad) + (Eigen::Matrix3d::Identity() - along) / Square(across_rad);
}

// Adds the derivative of a point with respect to a joint's rotation. A rotation by omega (world)
// moves the point by `turned` x omega; the unknown is a rotation in the parent's frame.
void AddTurn(const Eigen::Matrix3d& turned, int joint, int parent, Eigen::Index row,
             const JointPlacement& joints, Eigen::MatrixXd* jacobian) {
  auto block = jacobian->block<3, 3>(row, 3 + 3 * joint);
  if (parent < 0) {
    block += turned;
  } else {
    block.noalias() += turned * joints.rotations[parent];
  }
}

}  // namespace

void LandmarkTerm::AddCost(const FitPlaces& places, const Eigen::Matrix3Xd& targets,
                           double* cost) const {
  const double information = 1.0 / Square(accuracy_m_);
  for (int i = 0; i < marks_.size(); ++i)
    *cost += Square(marks_[i].weight) * information * Missed(i, places, targets).squaredNorm();
}

void LandmarkTerm::Linearise(const FitPlaces& places, const Eigen::Matrix3Xd& targets,
                             FitRows* rows) const {
  for (int i = 0; i < marks_.size(); ++i) {
    const LandmarkSet::Mark& mark = marks_[i];
    const double root_information = mark.weight / accuracy_m_;
    rows->residual.segment<3>(3 * i) = root_information * Missed(i, places, targets);
    rows->jacobian.block<3, 3>(3 * i, 0) = root_information * Eigen::Matrix3d::Identity();
    for (const LandmarkSet::Point& point : mark.points) {
      const Eigen::Vector3d place = LandmarkSet::Position(point, places.joints);
      for (int joint = point.joint; joint >= 0; joint = skeleton_.parents[joint]) {
        const Eigen::Vector3d arm = place - places.joints.positions.col(joint);
        AddTurn(-root_information * point.weight * CrossMatrix(arm), joint,
                skeleton_.parents[joint], 3 * i, places.joints, &rows->jacobian);
      }
    }
  }
}

HingePlaneTerm::HingePlaneTerm(const Skeleton& skeleton, const LandmarkSet& marks)
    : skeleton_(skeleton) {
  for (const Hinge& hinge : Hinges(skeleton)) {
    if (hinge.upper < 0) continue;
    const int upper_mark = marks.AtJoint(hinge.upper);
    const int hinge_mark = marks.AtJoint(hinge.joint);
    for (int end = 0; end < marks.size() && upper_mark >= 0 && hinge_mark >= 0; ++end) {
      if (marks[end].parent != hinge_mark) continue;
      planes_.push_back({.upper_joint = hinge.upper,
                         .upper_mark = upper_mark,
                         .hinge_mark = hinge_mark,
                         .end_mark = end,
                         .axis = hinge.axis});
      break;
    }
  }
}

void HingePlaneTerm::Aim(const Eigen::Matrix3Xd& targets) {
  for (HingePlane& plane : planes_) {
    const Eigen::Vector3d upper = targets.col(plane.hinge_mark) - targets.col(plane.upper_mark);
    const Eigen::Vector3d lower = targets.col(plane.end_mark) - targets.col(plane.hinge_mark);
    const Eigen::Vector3d normal = upper.cross(lower);
    const double sine = normal.norm() / std::max(1e-9, upper.norm() * lower.norm());
    // In a limb that is bent less than the threshold, the plane is noise and may look bent
    // backwards.
    const double sureness = std::max(0.0, sine - kSineOfSureBend) / (1.0 - kSineOfSureBend);
    plane.weight = sureness / kHingePlane;
    if (sureness > 0) plane.normal = normal.normalized();
  }
}

void HingePlaneTerm::AddCost(const FitPlaces& places, double* cost) const {
  for (const HingePlane& plane : planes_)
    *cost += Square(plane.weight) * (Axis(plane, places) - plane.normal).squaredNorm();
}

void HingePlaneTerm::Linearise(const FitPlaces& places, FitRows* rows) const {
  Eigen::Index row = rows->residual.size() - this->rows();
  for (const HingePlane& plane : planes_) {
    const Eigen::Vector3d axis = Axis(plane, places);
    rows->residual.segment<3>(row) = plane.weight * (axis - plane.normal);
    const Eigen::Matrix3d turned = -plane.weight * CrossMatrix(axis);
    for (int joint = plane.upper_joint; joint >= 0; joint = skeleton_.parents[joint])
      AddTurn(turned, joint, skeleton_.parents[joint], row, places.joints, &rows->jacobian);
    row += 3;
  }
}

JointTerm::JointTerm(const Skeleton& skeleton, const FitOptions& options, double fps)
    : priors_(static_cast<size_t>(skeleton.joints())),
      change_information_(1.0 / Square(options.change_rad * kModelFps / fps)),
      limit_rad_(options.hinge_limit_rad) {
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const bool stiff = Contains(skeleton.joint_names[joint], {"spine", "collar", "neck", "head",
                                                              "wrist", "hand", "foot", "toe"});
    const double deviation = stiff ? options.stiff_rad : options.rest_rad;
    // The root may face anywhere.
    const double information = joint == 0 ? 0.0 : 1.0 / Square(deviation);
    priors_[joint] = {information * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
  }
  for (const Hinge& hinge : Hinges(skeleton)) {
    priors_[hinge.joint] = {AxisInformation(hinge.axis, options.rest_rad, options.hinge_side_rad),
                            hinge.axis};
    if (hinge.upper < 0) continue;
    priors_[hinge.upper].information =
        AxisInformation(skeleton.offsets.col(hinge.joint), options.twist_rad, options.rest_rad);
  }
  for (const int ankle : {skeleton.feet[0], skeleton.feet[2]}) {
    if (ankle <= 0) continue;
    priors_[ankle].information =
        AxisInformation(skeleton.offsets.col(ankle), options.foot_turn_rad, options.rest_rad);
  }
}

// A hinge that is bent far and also twisted is rotated by more than half a turn. The shorter way
// round would be a backwards bend, so it is wrong.
Eigen::Vector3d JointTerm::Prior::Turn(const Eigen::Vector3d& w) const {
  return w.norm() < kMaxShortTurn || hinge_axis.dot(w) >= 0 ? w : OtherWayRound(w);
}

// The angle by which a hinge is below straight (negative) or beyond the largest bend (positive),
// radians. 0 for other joints.
double JointTerm::Prior::Beyond(const Eigen::Vector3d& turn) const {
  if (hinge_axis.isZero()) return 0;
  const double bend = hinge_axis.dot(turn);
  return std::min(0.0, bend - kMinBend) + std::max(0.0, bend - kMaxHingeBend);
}

void JointTerm::AddCost(const Pose& pose, const FitNeighbours& neighbours, double* cost) const {
  for (int joint = 0; joint < std::ssize(priors_); ++joint) {
    const Prior& prior = priors_[joint];
    const Eigen::Vector3d w = prior.Turn(pose.rotations.col(joint));
    *cost += w.dot(prior.information * w);
    *cost += Square(prior.Beyond(w) / limit_rad_);
    for (const Pose* other : {neighbours.before, neighbours.after}) {
      if (other == nullptr) continue;
      *cost +=
          change_information_ * RotationDifference(other->rotations.col(joint), w).squaredNorm();
    }
  }
}

void JointTerm::Linearise(const Pose& pose, const FitNeighbours& neighbours,
                          Eigen::MatrixXd* normal, Eigen::VectorXd* gradient) const {
  for (int joint = 0; joint < std::ssize(priors_); ++joint) {
    const Prior& prior = priors_[joint];
    const Eigen::Vector3d w = prior.Turn(pose.rotations.col(joint));
    const Eigen::Matrix3d slope = LogJacobian(w);
    Eigen::Matrix3d information = prior.information;
    Eigen::Vector3d pull = prior.information * w;
    if (const double beyond = prior.Beyond(w); beyond != 0) {
      const double hard = 1.0 / Square(limit_rad_);
      information += hard * prior.hinge_axis * prior.hinge_axis.transpose();
      pull += hard * beyond * prior.hinge_axis;
    }
    auto own_normal = normal->block<3, 3>(3 + 3 * joint, 3 + 3 * joint);
    auto own_gradient = gradient->segment<3>(3 + 3 * joint);
    own_normal += slope.transpose() * information * slope;
    own_gradient += slope.transpose() * pull;
    for (const Pose* other : {neighbours.before, neighbours.after}) {
      if (other == nullptr) continue;
      // log(R R_other^T), in the parent's frame like delta. Its Jacobian is nearly the identity.
      const Eigen::Vector3d change = ExpFromQuaternion(
          QuaternionFromExp(w) * QuaternionFromExp(other->rotations.col(joint)).conjugate());
      own_normal.diagonal().array() += change_information_;
      own_gradient += change_information_ * change;
    }
  }
}

}  // namespace choreo
