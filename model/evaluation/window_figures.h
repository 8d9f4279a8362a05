#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>
#include <vector>

#include "model/evaluation/table.h"
#include "model/evaluation/windows.h"
#include "model/metrics/bootstrap.h"
#include "model/metrics/joint_track.h"

namespace choreo {

/// What one transition of one method is worth.
struct WindowFigures {
  size_t clip = 0;
  double l2p = 0;  ///< m
  double l2q = 0;
  double npss_sum = 0, npss_weight = 0;
  double pfc = 0;
  double skate_ratio = 0, p95_acceleration = 0, max_acceleration = 0;  ///< quality_report.h
  double key_distance = 0;                     ///< KPD at the last frame, m^2
  double final_key_m = 0, final_key_deg = 0;   ///< ComparePoses there: the worst joint
  double raw_key_distance = 0, raw_key_m = 0;  ///< the same without arrival, foot lock
  Pace pace;
  Eigen::VectorXd kinetic, geometric;  ///< geometric: empty where the skeleton has none
};

/// `danced` and `real` begin with two frames of the history, so that a jolt at the start counts in
/// accelerations and skating; all else counts from the third frame on.
WindowFigures MeasureWindow(const Skeleton& skeleton, double fps, const std::vector<Pose>& danced,
                            const std::vector<Pose>& real);

inline constexpr int kFramesBefore = 2;

/// Mean over windows, times `unit`.
inline Cell Mean(const std::vector<WindowFigures>& windows, double WindowFigures::*figure,
                 double unit = 1) {
  return Mean(FiguresOf(windows, figure, unit));
}
double Largest(const std::vector<WindowFigures>& windows, double WindowFigures::*figure);

/// Real motion in feature space: windows of `frames` frames, half of them apart, over all clips.
struct RealFeatures {
  Eigen::MatrixXd kinetic, geometric;  ///< [features, windows]
};
RealFeatures GatherRealFeatures(const ClipSet& set, int frames);

/// Frechet distance to real motion and mean distance of pairs, both in units of the real features'
/// spread (Li et al. 2021); NaN where there are fewer than two windows or no features.
struct FeatureFigures {
  double distance = NAN, diversity = NAN;
};
FeatureFigures CompareFeatures(const Eigen::MatrixXd& real, const Eigen::MatrixXd& others);
FeatureFigures CompareFeatures(const Eigen::MatrixXd& real,
                               const std::vector<WindowFigures>& windows,
                               Eigen::VectorXd WindowFigures::*features);

}  // namespace choreo
