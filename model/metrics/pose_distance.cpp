#include "model/metrics/pose_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

// [features, frequencies]
Eigen::MatrixXd PowerSpectrum(const Eigen::MatrixXd& curves) {
  const Eigen::Index frames = curves.cols();
  Eigen::MatrixXd cosine(frames, frames), sine(frames, frames);
  for (Eigen::Index t = 0; t < frames; ++t) {
    for (Eigen::Index k = 0; k < frames; ++k) {
      const double angle = 2 * M_PI * static_cast<double>(t * k % frames) / frames;
      cosine(t, k) = std::cos(angle);
      sine(t, k) = std::sin(angle);
    }
  }
  return (curves * cosine).array().square() + (curves * sine).array().square();
}

}  // namespace

double L2P(const JointTrack& danced, const JointTrack& real) {
  CheckSameFrames(danced.size(), real.size());
  double sum = 0;
  for (size_t t = 0; t < real.size(); ++t) sum += (danced[t] - real[t]).colwise().norm().mean();
  return sum / real.size();
}

double KeyPoseDistance(const Eigen::Matrix3Xd& danced, const Eigen::Matrix3Xd& real) {
  return (danced - real).colwise().squaredNorm().mean();
}

Eigen::MatrixXd GlobalQuaternions(const Skeleton& skeleton, std::span<const Pose> poses) {
  Eigen::MatrixXd all(4 * skeleton.joints(), static_cast<Eigen::Index>(poses.size()));
  for (Eigen::Index t = 0; t < all.cols(); ++t) {
    const JointPlacement placement = ForwardKinematics(skeleton, poses[t]);
    for (int joint = 0; joint < skeleton.joints(); ++joint) {
      const Eigen::Quaterniond q(placement.rotations[joint]);
      Eigen::Vector4d value(q.w(), q.x(), q.y(), q.z());
      const bool flip = t == 0 ? value[0] < 0 : value.dot(all.block<4, 1>(4 * joint, t - 1)) < 0;
      all.block<4, 1>(4 * joint, t) = flip ? Eigen::Vector4d(-value) : value;
    }
  }
  return all;
}

double L2Q(const Eigen::MatrixXd& danced, const Eigen::MatrixXd& real) {
  CheckSameFrames(danced.cols(), real.cols());
  double sum = 0;
  for (Eigen::Index t = 0; t < real.cols(); ++t) {
    double squares = 0;
    for (Eigen::Index row = 0; row < real.rows(); row += 4) {
      const Eigen::Vector4d a = danced.block<4, 1>(row, t), b = real.block<4, 1>(row, t);
      squares += std::min((a - b).squaredNorm(), (a + b).squaredNorm());
    }
    sum += std::sqrt(squares);
  }
  return sum / real.cols();
}

Npss MeasureNpss(const Eigen::MatrixXd& danced, const Eigen::MatrixXd& real) {
  CheckSameFrames(danced.cols(), real.cols());
  Npss npss;
  const Eigen::MatrixXd ours = PowerSpectrum(danced), theirs = PowerSpectrum(real);
  for (Eigen::Index feature = 0; feature < real.rows(); ++feature) {
    const double our_power = ours.row(feature).sum(), power = theirs.row(feature).sum();
    if (our_power <= 0 || power <= 0) continue;
    double distance = 0, difference = 0;
    for (Eigen::Index k = 0; k < real.cols(); ++k) {
      difference += ours(feature, k) / our_power - theirs(feature, k) / power;
      distance += std::abs(difference);
    }
    npss.sum += power * distance;
    npss.weight += power;
  }
  return npss;
}

}  // namespace choreo
