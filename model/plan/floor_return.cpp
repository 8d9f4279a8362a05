#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/numbers/smooth_step.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/plan/plan_stages.h"

namespace choreo {

void ReturnToFloor(const PlanContext& context, std::vector<Pose>* plan) {
  if (context.keyed || (context.has_path && context.has_heights)) return;
  const Skeleton& skeleton = context.skeleton;
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  double clearance = std::numeric_limits<double>::infinity();
  for (const Pose& pose : *plan) {
    const Eigen::Matrix3Xd positions = JointPositions(skeleton, pose);
    for (const int foot : skeleton.feet) {
      if (foot >= 0) clearance = std::min(clearance, positions(1, foot) - rest(1, foot));
    }
  }
  if (!std::isfinite(clearance)) return;
  for (size_t i = 0; i < plan->size(); ++i) {
    const double u = static_cast<double>(i + 1) / static_cast<double>(plan->size());
    (*plan)[i].root_position.y() -= SmoothStep(u) * clearance;
  }
}

}  // namespace choreo
