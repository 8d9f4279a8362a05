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
  /// The pelvis's displacement from the plan in the last two frames, oldest first, metres.
  Eigen::Matrix<double, 3, 2> offset = Eigen::Matrix<double, 3, 2>::Zero();
};

/// Corrects a plan's footwork. Plans the stances of both feet for all frames at once
/// (contact_plan.h), and on a path steps to where the body needs support. Moves toes between
/// stances (toes_path.h), and moves the pelvis so that legs reach and the body is balanced
/// (pelvis_offset.h). Inverse kinematics then poses the legs. Leaves plans unchanged for skeletons
/// without legs or with unknown masses (motion/kinematics/body_mass.h). Pure, thread-safe.
Footwork StandOnFeet(const FootworkContext& context, std::vector<Pose>* plan);

}  // namespace choreo
