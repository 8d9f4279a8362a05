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
  /// The spec is valid (ValidateSpec). A key can be reached by turning either way round: the plan
  /// goes on turning as the last frames do, unless it swings round in a few frames so, on a turn of
  /// a quarter or more, and the plan of the other way does so less.
  TransitionPlan Plan(const TransitionSpec& spec) const;

 private:
  /// The root turns to the key by the rotation vector `turn`, or by what the plan adds to it; zero
  /// without a key for it.
  virtual TransitionPlan PlanTurning(const TransitionSpec& spec,
                                     const Eigen::Vector3d& turn) const = 0;
};

}  // namespace choreo
