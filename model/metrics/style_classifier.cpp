#include "model/metrics/style_classifier.h"

#include "model/core/error.h"
#include "model/metrics/linear.h"

namespace choreo {

StyleClassifier::StyleClassifier(const CriticWindows& windows, int styles) {
  Eigen::VectorXd count = Eigen::VectorXd::Zero(styles);
  for (const size_t style : windows.clips) ++count[style];
  if (count.minCoeff() == 0) throw InvalidArgument("styles", "one has no window to learn it from");
  Eigen::MatrixXd seen = SideBySide(windows.features);
  Eigen::VectorXd weight(seen.cols());  // gives each style the same total
  for (Eigen::Index i = 0; i < seen.cols(); ++i) weight[i] = 1 / (styles * count[windows.clips[i]]);
  mean_ = seen * weight;
  seen.colwise() -= mean_;
  over_deviation_ = (seen.array().square().matrix() * weight).array().max(1e-12).rsqrt();
  seen = over_deviation_.asDiagonal() * seen;
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(seen.rows(), styles);
  for (Eigen::Index i = 0; i < seen.cols(); ++i)
    means.col(windows.clips[i]) += weight[i] * seen.col(i);
  weights_ = SolveRidge(seen * weight.asDiagonal() * seen.transpose(), means).transpose();
}

int StyleClassifier::Classify(const Eigen::VectorXd& features) const {
  Eigen::Index best = 0;
  (weights_ * over_deviation_.cwiseProduct(features - mean_)).maxCoeff(&best);
  return static_cast<int>(best);
}

}  // namespace choreo
