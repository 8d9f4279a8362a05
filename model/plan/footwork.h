#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"
#include "model/plan/footwork_options.h"

namespace choreo {

/// A plan that needs footwork. All poses are in one frame with the floor at y = 0.
struct FootworkContext {
  const Skeleton& skeleton;
  std::span<const Pose> history;  ///< before the first frame, oldest first, at least one
  bool keyed = false;             ///< the last pose is a key, which must not change
  bool held = false;              ///< the plan holds the pose of the last history frame
  bool has_path = false,
       has_heights = false;  ///< a path fixes the root on the floor, and its height
  /// Footwork::offset of the preceding frames, if they had footwork.
  Eigen::Matrix<double, 3, 2> offset_before = Eigen::Matrix<double, 3, 2>::Zero();
  double fps;
  FootworkOptions options = {};
};

/// The result of footwork.
struct Footwork {
  std::vector<Contacts> contacts;  ///< per frame; empty: the plan is unchanged
  /// How far the pelvis moved from the plan in the last two frames, oldest first, metres.
  Eigen::Matrix<double, 3, 2> offset = Eigen::Matrix<double, 3, 2>::Zero();
};

/// Puts a plan on its feet. Plans for all frames at once which foot stands where (contact_plan.h);
/// steps to where the body needs support on a path; moves toes between stances (toes_path.h); moves
/// the pelvis so that legs reach and the body is balanced (pelvis_offset.h); legs follow by inverse
/// kinematics. Leaves skeletons without legs or with unknown masses (motion/body_mass.h) unchanged.
/// Pure, thread-safe.
Footwork StandOnFeet(const FootworkContext& context, std::vector<Pose>* plan);

}  // namespace choreo
