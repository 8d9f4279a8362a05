#pragma once

#include "model/plan/plan_stage.h"

namespace choreo {

/// Knees and elbows bend one way, until the limb is folded: the bend of each about its hinge is led
/// softly to a stop at both ends. One that is a tenth of a radian from both stays as it is.
class HingeLimit final : public PlanStage {
 public:
  struct Options {
    double softness_rad = 0.03;  ///< of bend, over which a hinge is led to a stop
    double folded_rad = 2.7;     ///< a calf on its thigh
  };
  HingeLimit() = default;
  explicit HingeLimit(const Options& options) : options_(options) {}
  void Apply(const PlanContext& context, std::vector<Pose>* plan) const override;

 private:
  Options options_;
};

}  // namespace choreo
