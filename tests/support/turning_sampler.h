#pragma once

#include "model/motion/rotation.h"
#include "tests/support/fake_sampler.h"

namespace choreo {

/// A model that turns on the spot by `step` radians per frame, leaning by `tilt`. Its left elbow
/// does the same.
class TurningSampler final : public FakeSampler {
 public:
  TurningSampler(double step, double tilt) : step_(step), tilt_(tilt) {}

  void OnFrame(const TransitionSpec& spec, Plan* plan) override {
    const auto here = std::ssize(plan->poses);
    // The elbow continues across transitions; the root's heading is relative to the canonical
    // frame.
    plan->poses.back().rotations.col(0) = Turned(here);
    plan->poses.back().rotations.col(model_.skeleton.left_elbow) = Turned(spec.first_frame + here);
  }

 private:
  Eigen::Vector3d Turned(int64_t frames) const {
    return LogMap(HeadingRotation(step_ * static_cast<double>(frames)) * ExpMap({tilt_, 0, 0}));
  }

  double step_;
  double tilt_;
};

}  // namespace choreo
