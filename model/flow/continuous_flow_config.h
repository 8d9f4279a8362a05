#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/flow/plan_options.h"
#include "model/motion/velocity_factors.h"

namespace choreo {

/// Shape of the continuous flow and how it is sampled. Stored in every checkpoint.
struct ContinuousFlowConfig {
  std::string name = "default";         ///< as servers list the model
  int history_frames = kHistoryFrames;  ///< tau
  int window_frames = 96;  ///< most frames of a window; longer transitions are cut into several
  int max_transition_frames = kMaxTransitionFrames;

  /// The transformer: two frames a token.
  int width = 224, layers = 6, heads = 7;
  int condition = 128;  ///< of what each block is modulated by: time, history, key, style

  int steps = 3;           ///< K, evaluations of the network from noise to motion
  double temperature = 1;  ///< served by default, as FlowNoise has it
  /// What beats and style change in F is done so many times (classifier-free guidance, Ho &
  /// Salimans 2022); other than 1 it takes twice the evaluations where one of them is told.
  double guidance = 2;
  std::vector<std::string> styles = {};  ///< that it was told of in training
  /// Medians of the velocity factors of the training clips, metres a frame.
  std::array<double, kBodyParts> median_factors = {};
  PlanOptions plan = {};

  /// Throws Error(kInvalidArgument) below `field` for steps out of range, and as plan does.
  void Validate(const std::string& field) const;
};

void to_json(nlohmann::json& json, const ContinuousFlowConfig& config);
void from_json(const nlohmann::json& json, ContinuousFlowConfig& config);

}  // namespace choreo
