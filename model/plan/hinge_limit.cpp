#include <cmath>

#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

constexpr double kSoftness = 0.03;  // radians of bend, over which a hinge is led to a stop

// As max(0, bend), but smooth.
double SoftBend(double bend) {
  const double share = bend / kSoftness;
  return share > 30 ? bend : kSoftness * std::log1p(std::exp(share));
}

}  // namespace

void LimitHinges(const PlanContext& context, std::vector<Pose>* plan) {
  const std::vector<Hinge> hinges = Hinges(context.skeleton);
  for (Pose& pose : *plan) {
    for (const Hinge& hinge : hinges) {
      auto rotation = pose.rotations.col(hinge.joint);
      const double bend = hinge.axis.dot(rotation);
      const double possible = kMostHingeBend - SoftBend(kMostHingeBend - SoftBend(bend));
      rotation += (possible - bend) * hinge.axis;
    }
  }
}

}  // namespace choreo
