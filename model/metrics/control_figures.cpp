#include "model/metrics/control_figures.h"

#include <numbers>

#include "model/core/error.h"

namespace choreo {

double RootRelativeDistance(const JointTrack& danced, const JointTrack& real) {
  CheckSameFrames(danced.size(), real.size());
  double sum = 0;
  for (size_t i = 0; i < danced.size(); ++i) {
    // The root's column is zero in both.
    const Eigen::Matrix3Xd here = danced[i].colwise() - danced[i].col(0);
    const Eigen::Matrix3Xd there = real[i].colwise() - real[i].col(0);
    sum += (here - there).norm();
  }
  return sum / danced.size();
}

SpeedTrack TrackPartSpeeds(const BodyPartWeights& weights, const JointTrack& track) {
  if (track.size() < 2) throw InvalidArgument("track", "has no step from frame to frame");
  SpeedTrack factors(kBodyParts, track.size() - 1);
  for (size_t i = 1; i < track.size(); ++i) {
    const auto of_step = PartSpeeds(weights, track[i - 1], track[i]);
    factors.col(i - 1) = Eigen::Map<const Eigen::Matrix<double, kBodyParts, 1>>(of_step.data());
  }
  return factors;
}

double VelocityDeviation(const SpeedTrack& danced, const SpeedTrack& requested) {
  CheckSameFrames(danced.cols(), requested.cols());
  return (danced - requested).cwiseAbs().mean();
}

double RootDeviation(const JointTrack& danced, const Eigen::Matrix3Xd& requested) {
  CheckSameFrames(danced.size(), requested.cols());
  double sum = 0;
  for (size_t i = 0; i < danced.size(); ++i) sum += (danced[i].col(0) - requested.col(i)).norm();
  return sum / danced.size();
}

double TremorShare(const JointTrack& track, double fps) {
  if (track.size() < 9) throw InvalidArgument("track", "has fewer than 9 frames");
  const auto steps = static_cast<Eigen::Index>(track.size()) - 1;
  const Eigen::Index width = 3 * (track.front().cols() - 1);
  const auto from_root = [&](Eigen::Index frame) {
    const Eigen::Matrix3Xd& joints = track[frame];
    const Eigen::Matrix3Xd relative = joints.rightCols(joints.cols() - 1).colwise() - joints.col(0);
    return Eigen::RowVectorXd(relative.reshaped().transpose());
  };
  Eigen::MatrixXd velocities(steps, width);  // a step a row
  for (Eigen::Index i = 0; i < steps; ++i) velocities.row(i) = from_root(i + 1) - from_root(i);
  velocities.rowwise() -= Eigen::RowVectorXd(velocities.colwise().mean());
  constexpr double kTurn = 2 * std::numbers::pi;
  const Eigen::ArrayXd turns =
      Eigen::ArrayXd::LinSpaced(steps, 0, static_cast<double>(steps - 1)) * kTurn / steps;
  velocities.array().colwise() *=
      0.5 - 0.5 * (turns + kTurn / 2 / static_cast<double>(steps)).cos();
  double all = 0, fast = 0;
  for (Eigen::Index k = 1; k <= steps / 2; ++k) {
    const Eigen::ArrayXd angles = turns * static_cast<double>(k);
    const double energy = (angles.cos().matrix().transpose() * velocities).squaredNorm() +
                          (angles.sin().matrix().transpose() * velocities).squaredNorm();
    all += energy;
    if (static_cast<double>(k) * fps > kTremorHz * steps) fast += energy;
  }
  return all > 0 ? fast / all : 0;
}

}  // namespace choreo
