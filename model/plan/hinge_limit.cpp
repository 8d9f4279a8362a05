#include <cmath>

#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

// As max(0, bend), but smooth.
double SoftBend(double bend, double softness) {
  const double share = bend / softness;
  return share > 30 ? bend : softness * std::log1p(std::exp(share));
}

}  // namespace

void LimitHinges(const PlanContext& context, std::vector<Pose>* plan) {
  const std::vector<Hinge> hinges = Hinges(context.skeleton);
  const double softness = context.options.hinge_softness;
  for (Pose& pose : *plan) {
    for (const Hinge& hinge : hinges) {
      auto rotation = pose.rotations.col(hinge.joint);
      const double bend = hinge.axis.dot(rotation);
      const double opened = SoftBend(bend, softness),
                   possible = kMostHingeBend - SoftBend(kMostHingeBend - opened, softness);
      rotation += (possible - bend) * hinge.axis;
    }
  }
}

}  // namespace choreo
