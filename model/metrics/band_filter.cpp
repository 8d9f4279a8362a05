#include "model/metrics/band_filter.h"

#include <algorithm>
#include <cmath>

namespace choreo {
namespace {

// One pass in place, starting in the steady state of the first value.
void RunForwards(double fps, double hz, Eigen::VectorXd& x) {
  const double warped = std::tan(M_PI * hz / fps);
  const double scale = 1 / (1 + std::sqrt(2.0) * warped + warped * warped);
  const double b0 = warped * warped * scale;
  const double a1 = 2 * (warped * warped - 1) * scale;
  const double a2 = (1 - std::sqrt(2.0) * warped + warped * warped) * scale;
  double in1 = x[0], in2 = x[0], out1 = x[0], out2 = x[0];
  for (Eigen::Index t = 0; t < x.size(); ++t) {
    const double in = x[t];
    const double out = b0 * (in + 2 * in1 + in2) - a1 * out1 - a2 * out2;
    in2 = in1, in1 = in;
    out2 = out1, out1 = out;
    x[t] = out;
  }
}

}  // namespace

Eigen::VectorXd LowPass(const Eigen::VectorXd& values, double fps, double hz) {
  const Eigen::Index count = values.size();
  if (count < 4) return values;
  // Three periods of the edge frequency, after which the filter has forgotten its initial state.
  const auto pad = std::min<Eigen::Index>(count - 1, std::lround(std::ceil(3 * fps / hz)));
  Eigen::VectorXd padded(count + 2 * pad);
  padded.segment(pad, count) = values;
  for (Eigen::Index i = 1; i <= pad; ++i) {
    padded[pad - i] = 2 * values[0] - values[i];
    padded[pad + count - 1 + i] = 2 * values[count - 1] - values[count - 1 - i];
  }
  RunForwards(fps, hz, padded);
  padded.reverseInPlace();
  RunForwards(fps, hz, padded);
  padded.reverseInPlace();
  return padded.segment(pad, count);
}

JointTrack LowPass(const JointTrack& track, double fps, double hz) {
  JointTrack smooth = track;
  Eigen::VectorXd values(static_cast<Eigen::Index>(track.size()));
  for (Eigen::Index i = 0; !track.empty() && i < track[0].size(); ++i) {
    for (Eigen::Index t = 0; t < values.size(); ++t) values[t] = track[t].data()[i];
    values = LowPass(values, fps, hz);
    for (Eigen::Index t = 0; t < values.size(); ++t) smooth[t].data()[i] = values[t];
  }
  return smooth;
}

}  // namespace choreo
