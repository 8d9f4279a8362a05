#pragma once

#include <optional>
#include <vector>

#include "model/engine/step_engine.h"

namespace choreo {

/// The baseline of paper F's Table 2 as an engine, so that it passes the same pipeline as a model
/// (arrival, foot lock): linear for the root, spherical for the joints, from the last history pose
/// to the key, or on the path that was asked for. Without a target its posture stands still. Not
/// thread-safe.
class InterpolationEngine : public StepEngine {
 public:
  /// Looks like `model` in all that a request depends on.
  explicit InterpolationEngine(ModelInfo model, int slots = 16);

  const ModelInfo& model() const override { return model_; }
  std::string device() const override { return "cpu"; }
  int slots() const override { return static_cast<int>(slots_.size()); }
  int free_slots() const override;
  int Admit(const TransitionSpec& spec) override;
  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override;
  void Release(int slot) noexcept override { slots_[static_cast<size_t>(slot)].reset(); }

 private:
  struct Way {
    Pose from, to;
    int frames, done;
    Eigen::Matrix3Xf path;
  };
  ModelInfo model_;
  std::vector<std::optional<Way>> slots_;
};

}  // namespace choreo
