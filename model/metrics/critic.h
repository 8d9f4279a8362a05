#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/metrics/joint_track.h"

/// A small fixed classifier that tries to distinguish generated from real motion by the joints'
/// movement within a second. The worse it does, the more lifelike the dance. Only for measuring:
/// nothing may be trained or selected by it.
namespace choreo {

/// Windows of one kind of motion, as input of a critic.
struct CriticWindows {
  std::vector<Eigen::VectorXd> features;  ///< [windows] features of the joints' movement
  std::vector<size_t> clips;              ///< [windows] the window's clip; folds never split a clip

  /// Cuts a motion into adjoining windows of one second from its first frame on.
  void Add(const JointTrack& track, double fps, size_t clip);
};

/// The area under the ROC curve: the probability that a random value of `high` exceeds a random
/// value of `low`; ties count half. 0.5 is chance, 1 perfect. NaN if either is empty.
double AreaUnderCurve(const std::vector<double>& high, const std::vector<double>& low);

inline constexpr int kCriticProjections = 128;
/// The area under the curve of a ridge regression on the features and on `projections` fixed random
/// rectified projections of them. Cross-validates over at most five folds of clips, so that a
/// critic never judges a window of a clip that it was fitted to. Averages areas over folds, whose
/// scales differ. NaN for fewer than two clips. Deterministic.
double CriticArea(const CriticWindows& real, const CriticWindows& danced,
                  int projections = kCriticProjections);

/// CriticArea of real motion against itself: splits each clip's windows at random between both
/// sides; the mean of five splits. Between 0.45 and 0.55 the critic is fair; otherwise there is too
/// little motion.
double RealAgainstReal(const CriticWindows& real);

}  // namespace choreo
