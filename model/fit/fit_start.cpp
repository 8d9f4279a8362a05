#include "model/fit/fit_start.h"

#include <Eigen/SVD>
#include <algorithm>

#include "model/motion/rotation.h"

namespace choreo {
namespace {

// The rotation that best turns what made the right factors of a correlation matrix onto what made
// its left factors (Kabsch).
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& correlation) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

// What the parent's rotation weighs beside landmarks, square metres.
constexpr double kStays = 1e-4, kTrunkStays = 0.02;

}  // namespace

FitStart::FitStart(const Skeleton& skeleton, const LandmarkSet& marks,
                   const std::vector<HingePlane>& planes)
    : skeleton_(skeleton), marks_(marks), planes_(planes) {
  const JointPlacement rest = ForwardKinematics(skeleton_, RestPose(skeleton_));
  rest_joints_ = rest.positions;
  rest_marks_ = marks_.Positions(rest);
}

bool FitStart::InTrunk(int joint) const {
  return joint > 0 && IsBelow(skeleton_.left_shoulder, joint, skeleton_.parents) &&
         IsBelow(skeleton_.right_shoulder, joint, skeleton_.parents);
}

double FitStart::TrunkTurn(const Pose& pose) const {
  double turn = 0;
  for (int joint = 1; joint < skeleton_.joints(); ++joint) {
    if (InTrunk(joint)) turn += pose.rotations.col(joint).norm();
  }
  return turn;
}

void FitStart::Start(const Eigen::Matrix3Xd& targets, Pose& pose) const {
  const int joints = skeleton_.joints();
  pose.rotations.setZero(3, joints);
  Eigen::Matrix3Xd places(3, joints);
  std::vector<Eigen::Matrix3d> turns(joints, Eigen::Matrix3d::Identity());
  std::vector<char> below(marks_.size());
  for (int joint = 0; joint < joints; ++joint) {
    const int parent = skeleton_.parents[joint];
    if (parent >= 0) {
      places.col(joint) = places.col(parent) + turns[parent] * skeleton_.offsets.col(joint);
    }
    // The root turns about the root landmark, whose place is known; every other joint about itself.
    Eigen::Vector3d pivot_target = targets.col(0);
    Eigen::Vector3d pivot_rest = rest_marks_.col(0);
    if (parent >= 0) {
      pivot_target = places.col(joint);
      pivot_rest = rest_joints_.col(joint);
    }
    for (int i = 0; i < marks_.size(); ++i) {
      below[i] =
          (parent >= 0 || i > 0) &&
          std::all_of(marks_[i].points.begin(), marks_[i].points.end(), [&](const auto& point) {
            return IsBelow(point.joint, joint, skeleton_.parents) &&
                   (point.joint != joint || !point.offset.isZero());
          });
    }
    // Where nothing tells, the parent's rotation goes on. The trunk's landmarks stand nearly on one
    // line and tell nothing of its twist: left to their noise, a start would be wound up by a whole
    // turn, and stay so, with hips and shoulders in their places.
    const Eigen::Matrix3d carried = parent < 0 ? Eigen::Matrix3d::Identity() : turns[parent];
    Eigen::Matrix3d correlation = (InTrunk(joint) ? kTrunkStays : kStays) * carried;
    bool told = false;
    for (int i = 0; i < marks_.size(); ++i) {
      if (!below[i] || (marks_[i].parent >= 0 && below[marks_[i].parent])) continue;
      told = true;
      correlation += marks_[i].weight * (targets.col(i) - pivot_target) *
                     (rest_marks_.col(i) - pivot_rest).transpose();
    }
    for (const HingePlane& hinge : planes_) {
      if (hinge.upper_joint != joint) continue;
      const Eigen::Vector3d upper = (targets.col(hinge.hinge_mark) - pivot_target).normalized();
      const Eigen::Vector3d lower =
          (targets.col(hinge.end_mark) - targets.col(hinge.hinge_mark)).normalized();
      const Eigen::Vector3d plane = upper.cross(lower);
      // A nearly straight limb whose plane says that it bends backwards is noise.
      const bool plausible = plane.norm() > kSineOfSureBend || plane.dot(carried * hinge.axis) > 0;
      if (plausible) correlation += 0.05 * plane * hinge.axis.transpose();
    }
    turns[joint] = told ? NearestRotation(correlation) : carried;
    if (parent < 0) {
      places.col(0) = targets.col(0) - turns[0] * (rest_marks_.col(0) - rest_joints_.col(0));
      pose.root_position = places.col(0);
    }
    pose.rotations.col(joint) = LogMap(carried.transpose() * turns[joint]);
  }
}

}  // namespace choreo
