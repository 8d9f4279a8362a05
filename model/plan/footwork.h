#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/flow/footwork_options.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A plan that is to stand on its feet. All poses stand in one frame, whose floor is y = 0.
struct FootworkContext {
  const Skeleton& skeleton;
  std::span<const Pose> history;  ///< before the first frame, oldest first, at least one
  bool keyed = false;             ///< the last pose is a key, which nothing may touch
  bool has_path = false;          ///< a path says where the root is on the floor
  /// Footwork::offset of the frames before, if they were put on their feet before.
  Eigen::Matrix<double, 3, 2> offset_before = Eigen::Matrix<double, 3, 2>::Zero();
  double fps;
  FootworkOptions options = {};
};

/// What a plan has come to.
struct Footwork {
  std::vector<Contacts> contacts;  ///< of each frame; none: it was left as it is
  /// By how much the pelvis left the plan in the last two frames, oldest first, metres.
  Eigen::Matrix<double, 3, 2> offset = Eigen::Matrix<double, 3, 2>::Zero();
};

/// Puts a plan on its feet. Which foot stands where is planned
/// for all frames at once (contact_plan.h); toes go from place to place (toes_path.h); the pelvis
/// follows, so that legs reach and the body is balanced (pelvis_offset.h); legs do the rest by
/// inverse kinematics. A skeleton without legs, or whose masses nobody knows (motion/body_mass.h),
/// is left as it is. Pure, thread-safe.
Footwork StandOnFeet(const FootworkContext& context, std::vector<Pose>* plan);

}  // namespace choreo
