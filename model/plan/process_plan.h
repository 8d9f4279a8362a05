#pragma once

#include "model/core/running/slices.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/plan/sampler.h"

namespace choreo {

/// A plan that can be danced, in the plan's canonical frame.
struct ProcessedPlan {
  Plan plan;  ///< as danced, with contacts
  /// The error in the last frame before arrival, relative to the target; 0 without a target.
  PoseError raw_error = {};
  double correction_m = 0;  ///< the farthest that arrival moves a joint, metres
};

/// Turns a network's plan into the frames of a dance, in this order: the plan's stages
/// (plan_stages.h), for models that have them; the key's hit; arrival (arrival.h); footwork
/// (footwork.h); contacts. `held`: the dancer holds the target's pose, so arrival's path alone
/// determines the poses. Pauses before each ten seconds of footwork. `model` and `valid` must
/// outlive the slices. Throws Error(kInternal) for a plan of the wrong length, and for any value
/// that is not finite as a float.
Slices<ProcessedPlan> ProcessPlan(const ModelInfo& model, const ValidSpec& valid, bool held,
                                  Plan plan);

}  // namespace choreo
