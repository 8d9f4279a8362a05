#include "model/metrics/frechet.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

#include "model/core/error.h"

namespace choreo {
namespace {

struct Gaussian {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

Gaussian Fit(const Eigen::MatrixXd& set) {
  if (set.cols() < 2)
    throw InvalidArgument("features", std::to_string(set.cols()) + " motions, 2 are needed");
  Gaussian fit{set.rowwise().mean(), {}};
  const Eigen::MatrixXd centred = set.colwise() - fit.mean;
  fit.covariance = centred * centred.transpose() / static_cast<double>(set.cols() - 1);
  return fit;
}

}  // namespace

FeatureScale FeatureScale::Of(const Eigen::MatrixXd& real) {
  const Gaussian fit = Fit(real);
  const auto root = [](double variance) { return variance > 1e-12 ? std::sqrt(variance) : 1.0; };
  return {fit.mean, fit.covariance.diagonal().unaryExpr(root)};
}

Eigen::MatrixXd FeatureScale::Apply(const Eigen::MatrixXd& features) const {
  return (features.colwise() - mean).array().colwise() / deviation.array();
}

double FrechetDistance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Gaussian first = Fit(a), second = Fit(b);
  // tr (C1 C2)^(1/2) = tr (R C2 R)^(1/2) with R = C1^(1/2): symmetric, so the roots are real.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(first.covariance);
  const Eigen::VectorXd roots = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Eigen::MatrixXd root =
      solver.eigenvectors() * roots.asDiagonal() * solver.eigenvectors().transpose();
  const Eigen::MatrixXd product = root * second.covariance * root;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> values(0.5 * (product + product.transpose()),
                                                              Eigen::EigenvaluesOnly);
  return (first.mean - second.mean).squaredNorm() + first.covariance.trace() +
         second.covariance.trace() - 2 * values.eigenvalues().cwiseMax(0).cwiseSqrt().sum();
}

double MeanPairDistance(const Eigen::MatrixXd& features) {
  const Eigen::Index count = features.cols();
  if (count < 2) return 0;
  double sum = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index k = 0; k < i; ++k) sum += (features.col(i) - features.col(k)).norm();
  }
  return 2 * sum / static_cast<double>(count * (count - 1));
}

}  // namespace choreo
