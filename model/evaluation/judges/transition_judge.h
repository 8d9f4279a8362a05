#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "model/evaluation/evaluation.h"
#include "model/metrics/joint_track.h"
#include "model/metrics/pose_distance.h"

namespace choreo {

inline constexpr int kFramesBefore = 2;  ///< frames of history before the measured ones

/// One method's figures for one transition.
struct WindowFigures {
  size_t clip = 0;
  double l2p = 0;       ///< m
  double l2p_norm = 0;  ///< m, all joints together (paper F, Eq. 10)
  double l2q = 0;
  Npss npss;
  double pfc = 0;
  double skate_ratio = 0, p95_acceleration = 0, max_acceleration = 0;  ///< quality_report.h
  double key_distance = 0;                     ///< KPD at the last frame, m^2
  double final_key_m = 0, final_key_deg = 0;   ///< ComparePoses at the last frame
  double raw_key_distance = 0, raw_key_m = 0;  ///< the same without arrival and footwork
  Pace pace;
  Eigen::VectorXd kinetic, geometric;  ///< geometric: empty if the skeleton has none
};
using Figures = std::vector<WindowFigures>;  ///< one per window, in order

/// Real motion in feature space: half-overlapping windows of `frames` frames over all clips.
struct RealFeatures {
  Eigen::MatrixXd kinetic, geometric;  ///< [features, windows]
};
RealFeatures GatherRealFeatures(const ClipSet& set, int frames);

/// The Frechet distance to real motion and the mean distance of pairs, in units of the real
/// features' spread (Li et al. 2021). NaN for fewer than two windows or no features.
struct FeatureFigures {
  double distance = NAN, diversity = NAN;
};
FeatureFigures CompareFeatures(const Eigen::MatrixXd& real, const Eigen::MatrixXd& others);
FeatureFigures CompareFeatures(const Eigen::MatrixXd& real, const Figures& windows,
                               Eigen::VectorXd WindowFigures::*features);

/// Runs methods on a set's windows at one length and measures the dances. Its arguments must
/// outlive it.
class TransitionJudge {
 public:
  TransitionJudge(const Evaluation& evaluation, const ModelInfo& model, int frames);

  const std::vector<EvalWindow>& windows() const { return windows_; }

  /// Measures a method. `candidate` numbers the samples of an engine.
  Figures Run(const Method& method, float temperature, uint32_t candidate = 0) const;
  /// The interpolation baseline: linear for the root, spherical for joints.
  Figures Interpolation() const { return Run({"", Method::Kind::kInterpolation}, 0); }

  /// Fills in an engine's raw key figures, with the same noise but without arrival and footwork.
  void AddRawKeys(Method method, float temperature, Figures* figures) const;

 private:
  Dances Dance(const Method& method, float temperature, uint32_t candidate) const;

  const Evaluation& evaluation_;
  const ModelInfo& model_;
  int frames_;
  std::vector<EvalWindow> windows_;
};

}  // namespace choreo
