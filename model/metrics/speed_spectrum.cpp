#include "model/metrics/speed_spectrum.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "model/core/error.h"

namespace choreo {
namespace {

// [steps, 3 * joints], m/s, under the window.
Eigen::MatrixXd WindowedVelocities(const JointTrack& track, double fps) {
  const auto steps = static_cast<Eigen::Index>(track.size()) - 1;
  Eigen::MatrixXd velocities(steps, track[0].size());
  for (Eigen::Index t = 0; t < steps; ++t) {
    Eigen::Matrix3Xd step = (track[t + 1] - track[t]) * fps;
    step.rightCols(step.cols() - 1).colwise() -= step.col(0).eval();
    const double window = 0.5 - 0.5 * std::cos(2 * M_PI * (static_cast<double>(t) + 0.5) /
                                               static_cast<double>(steps));
    // The window's mean square is 3/8.
    velocities.row(t) = step.reshaped().transpose() * (window / std::sqrt(0.375));
  }
  return velocities;
}

}  // namespace

Eigen::MatrixXd SpeedSpectrum(const JointTrack& track, double fps) {
  if (track.size() < 9)
    throw InvalidArgument("track", std::to_string(track.size()) + " frames, 9 are needed");
  const Eigen::MatrixXd velocities = WindowedVelocities(track, fps);
  const Eigen::Index steps = velocities.rows(), joints = track[0].cols();
  Eigen::MatrixXd power = Eigen::MatrixXd::Zero(kBands, 2 * joints);
  for (Eigen::Index bin = 0; 2 * bin <= steps; ++bin) {
    const double hz = static_cast<double>(bin) * fps / steps;
    const auto band = std::ranges::upper_bound(kBandEdges, hz) - kBandEdges.begin() - 1;
    if (band >= kBands) break;
    const Eigen::VectorXd angles = Eigen::VectorXd::LinSpaced(
        steps, 0, 2 * M_PI * static_cast<double>(bin * (steps - 1)) / steps);
    // Parseval: both halves of the spectrum, except for bins that mirror themselves.
    const double mirrored = bin == 0 || 2 * bin == steps ? 1 : 2;
    const Eigen::RowVectorXd squares =
        ((angles.array().cos().matrix().transpose() * velocities).array().square() +
         (angles.array().sin().matrix().transpose() * velocities).array().square()) *
        (mirrored / static_cast<double>(steps * steps));
    for (Eigen::Index joint = 0; joint < joints; ++joint) {
      power(band, 2 * joint) += squares[3 * joint] + squares[3 * joint + 2];
      power(band, 2 * joint + 1) += squares[3 * joint + 1];
    }
  }
  return power;
}

}  // namespace choreo
