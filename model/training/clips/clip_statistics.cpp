#include "model/training/clips/clip_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/core/numbers/quantile.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kCovarianceSigma = 30;  // frames of the taper that keeps covariances definite
constexpr double kMinSpeed = 1e-4;       // radians a frame

Eigen::VectorXd Velocity(const Pose& before, const Pose& now) {
  Eigen::VectorXd velocity(3 + now.rotations.size());
  velocity.head<3>() = now.root_position - before.root_position;
  for (Eigen::Index j = 0; j < now.rotations.cols(); ++j)
    velocity.segment<3>(3 + 3 * j) =
        RotationDifference(before.rotations.col(j), now.rotations.col(j));
  return velocity;
}

}  // namespace

std::array<double, kBodyParts> MedianFactors(std::span<const ClipTrack> tracks) {
  std::array<double, kBodyParts> medians;
  for (int part = 0; part < kBodyParts; ++part) {
    std::vector<double> values;
    for (const ClipTrack& track : tracks) {
      const auto row = track.energy.row(part);
      values.insert(values.end(), row.begin(), row.end());
    }
    medians[part] = Median(std::move(values));
  }
  return medians;
}

Eigen::MatrixXd VelocityCovariance(const Skeleton& skeleton, std::span<const ClipTrack> tracks,
                                   int lags) {
  const std::vector<int> pairs = MirrorPairs(skeleton);
  const int dimensions = 3 + 3 * skeleton.joints();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(dimensions, lags);
  double frames = 0;
  for (const ClipTrack& track : tracks) {
    const auto& poses = track.poses;
    if (poses.size() < 2) continue;
    Eigen::MatrixXd velocity(dimensions, static_cast<int>(poses.size()) - 1);
    for (int i = 0; i < velocity.cols(); ++i) velocity.col(i) = Velocity(poses[i], poses[i + 1]);
    for (int lag = 0; lag < std::min<int>(lags, static_cast<int>(velocity.cols())); ++lag) {
      const int count = static_cast<int>(velocity.cols()) - lag;
      sum.col(lag) +=
          velocity.leftCols(count).cwiseProduct(velocity.rightCols(count)).rowwise().sum();
    }
    frames += static_cast<double>(velocity.cols());
  }
  sum /= frames;
  for (int lag = 0; lag < lags; ++lag)
    sum.col(lag) *= std::exp(-0.5 * std::pow(lag / kCovarianceSigma, 2));
  // Positions are not in the dancer's frame, so sideways and forwards are equivalent; so are left
  // and right.
  const Eigen::RowVectorXd floor = 0.5 * (sum.row(0) + sum.row(2));
  sum.row(0) = sum.row(2) = floor;
  Eigen::MatrixXd covariance = sum;
  for (int j = 0; j < skeleton.joints(); ++j) {
    covariance.middleRows<3>(3 + 3 * j) =
        0.5 * (sum.middleRows<3>(3 + 3 * j) + sum.middleRows<3>(3 + 3 * pairs[j]));
  }
  // Keeps a minimum, because joints that recordings lack never move.
  covariance.col(0) = covariance.col(0).cwiseMax(kMinSpeed * kMinSpeed);
  return covariance;
}

UsualPose MeasureUsualPose(const Skeleton& skeleton, std::span<const ClipTrack> tracks) {
  const std::vector<int> pairs = MirrorPairs(skeleton);
  const int joints = skeleton.joints();
  // Visits each frame and its mirror image about the stage's middle.
  const auto visit = [&](auto what) {
    for (const ClipTrack& track : tracks) {
      for (const Pose& pose : track.poses) {
        Pose here = GroundFrame::Of(pose).ToLocal(pose);
        here.root_position.x() = pose.root_position.x() - track.stage.origin.x();
        here.root_position.z() = pose.root_position.z() - track.stage.origin.z();
        what(here);
        what(Mirror(pairs, here));
      }
    }
  };
  std::vector<Eigen::Matrix3d> turns(static_cast<size_t>(joints), Eigen::Matrix3d::Zero());
  double height = 0, poses = 0;
  visit([&](const Pose& pose) {
    for (int j = 0; j < joints; ++j) turns[j] += ExpMap(pose.rotations.col(j));
    height += pose.root_position.y();
    ++poses;
  });
  UsualPose usual{.pose = {{0, height / poses, 0}, Eigen::Matrix3Xd(3, joints)},
                  .variance = Eigen::VectorXd::Zero(3 + 3 * joints)};
  for (int j = 0; j < joints; ++j) usual.pose.rotations.col(j) = LogMap(NearestRotation(turns[j]));
  visit([&](const Pose& pose) {
    const Eigen::Vector3d off = usual.pose.root_position - pose.root_position;
    const double floor =
        0.5 * (off.x() * off.x() + off.z() * off.z());  // independent of the heading
    usual.variance.head<3>() += Eigen::Vector3d(floor, off.y() * off.y(), floor) / poses;
    for (int j = 0; j < joints; ++j) {
      usual.variance.segment<3>(3 + 3 * j) +=
          RotationDifference(pose.rotations.col(j), usual.pose.rotations.col(j)).cwiseAbs2() /
          poses;
    }
  });
  double poses_faced = 0;
  for (const ClipTrack& track : tracks) {
    for (const Pose& pose : track.poses) {
      const double off = GroundFrame::Of(pose).heading - track.stage.heading;
      usual.facing += WrapAngle(off) * WrapAngle(off);
      ++poses_faced;
    }
  }
  usual.facing /= poses_faced;
  return usual;
}

}  // namespace choreo
