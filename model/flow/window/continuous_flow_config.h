#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/plan/plan_options.h"

namespace choreo {

/// The farthest key in training: frames after the window's first.
inline constexpr int kSightFrames = 192;

/// The continuous flow's shape and sampling. Stored in every checkpoint.
struct ContinuousFlowConfig {
  std::string name = "default";         ///< the model's name in servers' lists
  int history_frames = kHistoryFrames;  ///< tau
  int window_frames = 96;               ///< the longest window; longer transitions are split
  int max_transition_frames = kMaxTransitionFrames;

  /// The transformer: two frames per token.
  int width = 224, layers = 6, heads = 7;
  int condition = 128;  ///< width of each block's conditioning: time, history, key, style

  int steps = 3;           ///< K, network evaluations from noise to motion
  double temperature = 1;  ///< the served default, as in TransitionNoise
  /// Multiplies the effect of beats and style on F (classifier-free guidance, Ho & Salimans 2022).
  /// Except for 1, guidance doubles the evaluations with a style, and takes one less than twice
  /// with beats alone.
  double guidance = 2;
  std::vector<std::string> styles = {};  ///< labels known from training
  /// Medians of the training clips' velocity factors, metres per frame.
  std::array<double, kBodyParts> median_factors = {};
  PlanOptions plan = {};

  /// Throws Error(kInvalidArgument) below `field` for steps out of range, and what `plan` throws.
  void Check(const std::string& field) const;
};

void to_json(nlohmann::json& json, const ContinuousFlowConfig& config);
void from_json(const nlohmann::json& json, ContinuousFlowConfig& config);

}  // namespace choreo
