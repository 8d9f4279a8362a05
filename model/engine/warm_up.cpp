#include "model/engine/warm_up.h"

#include <algorithm>
#include <array>

#include "model/motion/kinematics.h"

namespace choreo {
namespace {

constexpr int kFrames = 30;

}  // namespace

void WarmUp(StepEngine& engine) {
  const ModelInfo& model = engine.model();
  TransitionSpec spec;
  spec.frames = std::min(kFrames, model.max_transition_frames);
  spec.history.assign(static_cast<size_t>(model.history_frames), RestPose(model.skeleton));
  const int slot = engine.Admit(spec);
  Pose previous;
  for (int frame = 0; frame < spec.frames; ++frame) {
    std::array<StepOutput, 1> out;
    const StepInput in{.slot = slot, .previous = frame == 0 ? nullptr : &previous, .audio_row = {}};
    engine.Step({&in, 1}, out);
    previous = std::move(out[0].pose);
  }
  engine.Release(slot);
}

}  // namespace choreo
