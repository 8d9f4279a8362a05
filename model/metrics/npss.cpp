#include "model/metrics/npss.h"

#include <cmath>
#include <string>

#include "model/core/error.h"

namespace choreo {
namespace {

// [features, frequencies]
Eigen::MatrixXd PowerSpectrum(const Eigen::MatrixXd& curves) {
  const Eigen::Index frames = curves.cols();
  Eigen::MatrixXd cosine(frames, frames), sine(frames, frames);
  for (Eigen::Index t = 0; t < frames; ++t) {
    for (Eigen::Index k = 0; k < frames; ++k) {
      const double angle =
          2 * M_PI * static_cast<double>(t * k % frames) / static_cast<double>(frames);
      cosine(t, k) = std::cos(angle);
      sine(t, k) = std::sin(angle);
    }
  }
  return (curves * cosine).array().square() + (curves * sine).array().square();
}

}  // namespace

void NpssMeter::Add(const Eigen::MatrixXd& danced, const Eigen::MatrixXd& real) {
  if (danced.rows() != real.rows() || danced.cols() != real.cols()) {
    throw InvalidArgument("danced", std::to_string(danced.rows()) + " x " +
                                        std::to_string(danced.cols()) + " against " +
                                        std::to_string(real.rows()) + " x " +
                                        std::to_string(real.cols()));
  }
  const Eigen::MatrixXd ours = PowerSpectrum(danced), theirs = PowerSpectrum(real);
  for (Eigen::Index feature = 0; feature < real.rows(); ++feature) {
    const double our_power = ours.row(feature).sum(), power = theirs.row(feature).sum();
    if (our_power <= 0 || power <= 0) continue;
    double distance = 0, difference = 0;
    for (Eigen::Index k = 0; k < real.cols(); ++k) {
      difference += ours(feature, k) / our_power - theirs(feature, k) / power;
      distance += std::abs(difference);
    }
    sum_ += power * distance;
    weights_ += power;
  }
}

}  // namespace choreo
