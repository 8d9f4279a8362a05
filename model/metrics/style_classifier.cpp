#include "model/metrics/style_classifier.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "model/core/error.h"

namespace choreo {
namespace {

constexpr double kRidge = 0.1;  // of a feature's variance

}  // namespace

StyleClassifier::StyleClassifier(const CriticWindows& windows, int styles) {
  Eigen::VectorXd count = Eigen::VectorXd::Zero(styles);
  for (const size_t style : windows.clips) ++count[style];
  if (count.minCoeff() == 0) throw InvalidArgument("styles", "one has no window to learn it from");
  const Eigen::Index features = windows.features[0].size();
  // Windows by column, so weighed that each style has the same sum.
  Eigen::MatrixXd seen(features, std::ssize(windows.features));
  Eigen::VectorXd weight(seen.cols());
  for (Eigen::Index i = 0; i < seen.cols(); ++i) {
    seen.col(i) = windows.features[i];
    weight[i] = 1 / (styles * count[windows.clips[i]]);
  }
  mean_ = seen * weight;
  seen.colwise() -= mean_;
  over_deviation_ = (seen.array().square().matrix() * weight).array().max(1e-12).rsqrt();
  seen = over_deviation_.asDiagonal() * seen;
  Eigen::MatrixXd covariance = seen * weight.asDiagonal() * seen.transpose();
  covariance.diagonal().array() += kRidge;
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(features, styles);
  for (Eigen::Index i = 0; i < seen.cols(); ++i)
    means.col(windows.clips[i]) += weight[i] * seen.col(i);
  weights_ = covariance.llt().solve(means).transpose();
}

int StyleClassifier::Classify(const Eigen::VectorXd& features) const {
  Eigen::Index best = 0;
  (weights_ * over_deviation_.cwiseProduct(features - mean_)).maxCoeff(&best);
  return static_cast<int>(best);
}

}  // namespace choreo
