#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

/// Linear algebra shared by several metrics.
namespace choreo {

/// Joins vectors, or matrices with equal row counts, side by side. Empty for no parts.
template <typename Part>
Eigen::MatrixXd SideBySide(const std::vector<Part>& parts) {
  Eigen::Index columns = 0;
  for (const Part& part : parts) columns += part.cols();
  Eigen::MatrixXd all(parts.empty() ? 0 : parts[0].rows(), columns);
  columns = 0;
  for (const Part& part : parts) {
    all.middleCols(columns, part.cols()) = part;
    columns += part.cols();
  }
  return all;
}

/// Solves a ridge regression on features of mean 0 and variance 1. Returns the weights, given the
/// features' covariance (lower triangle) and `right`, their covariance with the target.
template <typename Right>
Right SolveRidge(Eigen::MatrixXd covariance, const Right& right) {
  constexpr double kRidge = 0.1;  // relative to a feature's variance
  covariance.diagonal().array() += kRidge;
  return covariance.llt().solve(right);
}

}  // namespace choreo
