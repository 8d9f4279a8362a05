#pragma once

#include "model/engine/slot_engine.h"

namespace choreo {

struct InterpolatedTransition {
  Pose from, to;
  int frames, done;
  Eigen::Matrix3Xd path;

  SlotProgress progress() const { return {done, frames, false}; }
};

/// The baseline of paper F's Table 2 as an engine, so that it passes the same pipeline as a model
/// (arrival, foot lock): linear for the root, spherical for the joints, from the last history pose
/// to the key, or on the path that was asked for. Without a target its posture stands still. Not
/// thread-safe.
class InterpolationEngine : public SlotEngine<InterpolatedTransition> {
 public:
  /// Looks like `model` in all that a request depends on.
  explicit InterpolationEngine(ModelInfo model, int slots = 16);

 protected:
  InterpolatedTransition Begin(const TransitionSpec& spec, int slot) override;
  void StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) override;
};

}  // namespace choreo
