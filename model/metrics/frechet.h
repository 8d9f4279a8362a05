#pragma once

#include <Eigen/Core>

/// How alike two sets of motions are, and how unlike the motions of one set, in some feature space.
/// A set is [features, motions].
namespace choreo {

/// Mean and standard deviation of a set of real motions; features that do not vary keep their unit.
struct FeatureScale {
  Eigen::VectorXd mean, deviation;

  static FeatureScale Of(const Eigen::MatrixXd& real);
  Eigen::MatrixXd Apply(const Eigen::MatrixXd& features) const;
};

/// Frechet distance of the Gaussians fitted to two sets (Heusel et al. 2017; paper F's reference
/// [52]): |m1 - m2|^2 + tr(C1 + C2 - 2 (C1 C2)^(1/2)). No unit. Sets with fewer motions than
/// features have singular covariances: the distance stays defined, and is biased upwards, so only
/// sets of like size compare. Throws Error(kInvalidArgument) for fewer than two motions.
double FrechetDistance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Mean distance of all pairs of a set: Div_k and Div_g of the field (Li et al. 2021). 0 for fewer
/// than two.
double MeanPairDistance(const Eigen::MatrixXd& features);

}  // namespace choreo
