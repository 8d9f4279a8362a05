#pragma once

#include <Eigen/Core>

/// Measures the similarity of two sets of motions and the diversity of one set in a feature space.
/// A set is [features, motions].
namespace choreo {

/// Standardises features by the mean and standard deviation of a set of real motions. Constant
/// features keep their unit.
struct FeatureScale {
  Eigen::VectorXd mean, deviation;

  static FeatureScale Of(const Eigen::MatrixXd& real);
  Eigen::MatrixXd Apply(const Eigen::MatrixXd& features) const;
};

/// Frechet distance of the Gaussians fitted to two sets (Heusel et al. 2017; paper F's reference
/// [52]): |m1 - m2|^2 + tr(C1 + C2 - 2 (C1 C2)^(1/2)). No unit. With fewer motions than features,
/// covariances are singular and the distance is biased upwards, so compare only sets of similar
/// size. Throws Error(kInvalidArgument) for fewer than two motions.
double FrechetDistance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The mean distance over all pairs of a set: Div_k and Div_g of the literature (Li et al. 2021). 0
/// for fewer than two motions.
double MeanPairDistance(const Eigen::MatrixXd& features);

}  // namespace choreo
