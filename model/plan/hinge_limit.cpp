#include <algorithm>
#include <cmath>

#include "model/motion/kinematics/limb.h"
#include "model/plan/plan_stages.h"

namespace choreo {
namespace {

// A smooth max(0, bend).
double SoftBend(double bend, double softness) {
  const double share = bend / softness;
  return share > 30 ? bend : softness * std::log1p(std::exp(share));
}

}  // namespace

void LimitHinges(const PlanContext& context, std::vector<Pose>* plan) {
  const double softness = context.options.hinge_softness;
  for (const Hinge& hinge : Hinges(context.skeleton)) {
    const auto bend_in = [&](const Pose& pose) {
      return hinge.axis.dot(pose.rotations.col(hinge.joint));
    };
    BendRange range;
    if (!context.history.empty())
      range = NextBend(bend_in(context.history.back()), 1 / context.fps);
    for (Pose& pose : *plan) {
      const double bend = bend_in(pose), opened = SoftBend(bend, softness),
                   possible = kMaxHingeBend - SoftBend(kMaxHingeBend - opened, softness),
                   limited = std::clamp(possible, range.least, range.most);
      pose.rotations.col(hinge.joint) += (limited - bend) * hinge.axis;
      range = NextBend(limited, 1 / context.fps);
    }
  }
}

}  // namespace choreo
