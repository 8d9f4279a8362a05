#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/metrics/joint_track.h"

/// A small fixed classifier that tries to distinguish generated from real motion by how joints move
/// within a second. The harder that is, the more lifelike the dance. Only for measuring: nothing
/// may be trained or selected by it.
namespace choreo {

/// Windows of one kind of motion, as the critic sees them.
struct CriticWindows {
  std::vector<Eigen::VectorXd> features;  ///< per window: how its joints move
  std::vector<size_t> clips;              ///< the clip of each window: folds never split a clip

  /// Cuts a motion into adjoining windows of one second from its first frame on.
  void Add(const JointTrack& track, double fps, size_t clip);
};

/// Area under the ROC curve: how often a random value of `high` exceeds a random one of `low`, ties
/// counting half; 0.5 is chance, 1 perfect. NaN if either is empty.
double AreaUnderCurve(const std::vector<double>& high, const std::vector<double>& low);

inline constexpr int kCriticProjections = 128;
/// The area under the curve of a ridge regression on the features and `projections` fixed random
/// rectified projections of them. Cross-validated over at most five folds of clips, so that each
/// window is judged by a critic that has not seen its clip; areas are averaged over folds, whose
/// scales differ. NaN for fewer than two clips. Deterministic.
double CriticArea(const CriticWindows& real, const CriticWindows& danced,
                  int projections = kCriticProjections);

/// The same for real motion against itself: each clip's windows are dealt at random to both sides,
/// mean of five deals. Between 0.45 and 0.55 the critic is fair; else there is too little motion.
double RealAgainstReal(const CriticWindows& real);

}  // namespace choreo
