#include "model/plan/hinge_limit.h"

#include <cmath>

namespace choreo {
namespace {

// As max(0, bend), but smooth.
double SoftBend(double bend, double softness) {
  const double share = bend / softness;
  return share > 30 ? bend : softness * std::log1p(std::exp(share));
}

}  // namespace

void HingeLimit::Apply(const PlanContext& context, std::vector<Pose>* plan) const {
  const std::vector<Hinge> hinges = Hinges(context.skeleton);
  const double folded = options_.folded_rad, softness = options_.softness_rad;
  for (Pose& pose : *plan) {
    for (const Hinge& hinge : hinges) {
      auto rotation = pose.rotations.col(hinge.joint);
      const double bend = hinge.axis.dot(rotation);
      const double possible = folded - SoftBend(folded - SoftBend(bend, softness), softness);
      rotation += (possible - bend) * hinge.axis;
    }
  }
}

}  // namespace choreo
