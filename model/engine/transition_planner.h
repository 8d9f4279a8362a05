#pragma once

#include <vector>

#include "model/engine/step_engine.h"

namespace choreo {

/// What is known of a transition before its first frame.
struct TransitionPlan {
  std::vector<Pose> poses;  ///< [N] reference poses of motion/pose_codec.h; empty: none
  /// [N, static width]: key pose, frames left and what the planner knows of each frame. Behind the
  /// shared encoding's first layer where the model has one, else as it is.
  std::vector<float> static_condition;
};

/// Plans transitions, once each, when they are admitted. Thread-safe.
class TransitionPlanner {
 public:
  virtual ~TransitionPlanner() = default;
  /// The spec is valid (ValidateSpec).
  virtual TransitionPlan Plan(const TransitionSpec& spec) const = 0;
};

}  // namespace choreo
