#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/metrics/joint_track.h"

/// A small fixed classifier that tries to tell danced from real motion by how joints move in a
/// second: the harder for it, the more alive the dance. It is for measuring alone; nothing may be
/// trained or chosen by it.
namespace choreo {

/// Windows of one kind of motion, as the critic sees them.
struct CriticWindows {
  std::vector<Eigen::VectorXd> features;  ///< of each: how joints move in it
  std::vector<size_t> clips;              ///< which clip each is of: folds never part a clip

  /// Cuts a motion into windows of one second, side by side from its first frame on.
  void Add(const JointTrack& track, double fps, size_t clip);
};

/// Area under the ROC curve: how often a random one of `high` is above a random one of `low`, ties
/// counting half; 0.5 tells nothing, 1 all. NaN where either is empty.
double AreaUnderCurve(const std::vector<double>& high, const std::vector<double>& low);

inline constexpr int kCriticProjections = 128;
/// The area under the curve of a ridge regression on the features and `projections` fixed random
/// rectified projections of them. Folds by clip, five at most: each window is judged by one that
/// has seen nothing of its clip; areas are means over folds, whose scales differ. NaN for fewer
/// than two clips. Deterministic.
double CriticArea(const CriticWindows& real, const CriticWindows& danced,
                  int projections = kCriticProjections);

/// The same for real motion against itself, each clip's windows dealt at random to both sides, mean
/// of five deals. Between 0.45 and 0.55 the critic is fair; else there is too little motion.
double RealAgainstReal(const CriticWindows& real);

}  // namespace choreo
