#pragma once

#include <vector>

#include "model/motion/rotation.h"
#include "tests/support/fake_engine.h"

namespace choreo {

/// Turns on the spot, `step` radians a frame, leaning by `tilt`; its left elbow does the same.
class TurningEngine final : public FakeEngine {
 public:
  TurningEngine(double step, double tilt) : step_(step), tilt_(tilt), frames_(16) {}

  int BeginAdmission(const TransitionSpec& spec) override {
    const int slot = FakeEngine::BeginAdmission(spec);
    // An elbow goes on from where it is; the root's heading is that of the canonical frame.
    frames_[static_cast<size_t>(slot)] = {0, spec.first_frame};
    return slot;
  }

  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override {
    FakeEngine::Step(in, out);
    for (size_t i = 0; i < in.size(); ++i) {
      Count& count = frames_[static_cast<size_t>(in[i].slot)];
      out[i].pose.rotations.col(0) = Turned(++count.here);
      out[i].pose.rotations.col(model_.skeleton.left_elbow) = Turned(count.before + count.here);
    }
  }

 private:
  struct Count {
    int64_t here = 0;  // frames of this transition
    int64_t before = 0;
  };

  Eigen::Vector3d Turned(int64_t frames) const {
    return LogMap(HeadingRotation(step_ * static_cast<double>(frames)) * ExpMap({tilt_, 0, 0}));
  }

  double step_;
  double tilt_;
  std::vector<Count> frames_;
};

}  // namespace choreo
