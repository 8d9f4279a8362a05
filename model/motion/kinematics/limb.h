#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// The bend below which a limb counts as straight, radians.
inline constexpr double kStraightBend = 5 / kDegrees;

/// A limb of two bones, as joint indices of a chain: hip, knee, ankle or shoulder, elbow, wrist.
struct Limb {
  int upper = -1, middle = -1, end = -1;
};

/// The first child of a joint, such as the hand of a wrist; -1 if it has none.
int FirstChild(const Skeleton& skeleton, int joint);

/// The range of a limb's bend, radians: 0 is straight, positive the natural way.
struct BendRange {
  double least = -M_PI, most = M_PI;
};

/// The bends that a limb bent by `bend` may reach within `seconds`. A nearly straight limb bends by
/// ten degrees when its end moves by a centimetre; in one frame that would be a snap.
BendRange NextBend(double bend, double seconds);

/// Two-bone inverse kinematics: turns the upper two joints so that the end reaches `goal`, given
/// relative to the upper joint, and keeps the end's global rotation. A bent limb bends in its
/// present plane, a straight one about `hinge`, the world direction of its natural axis. The result
/// is continuous in pose and goal. Near full length the end may miss the goal by a centimetre; if
/// the goal needs a bend outside `range`, the limb points at it. `placement` must be `pose`'s, and
/// is stale afterwards. Returns the bend, radians.
double PlaceEnd(const Limb& limb, const Eigen::Vector3d& hinge, const Skeleton& skeleton,
                const JointPlacement& placement, const Eigen::Vector3d& goal, Pose* pose,
                const BendRange& range = {});

/// Hip, knee, ankle and toes of one leg, by joint index.
struct Leg {
  int hip = -1, knee = -1, ankle = -1, toes = -1;

  /// Whether the skeleton's legs are chains of these joints.
  static bool In(const Skeleton& skeleton);
  /// The left and the right leg. Requires In(skeleton).
  static std::array<Leg, 2> Of(const Skeleton& skeleton);
};

/// The distance from hip to ankle over the length of thigh and shin, with the toes moved to `toes`
/// and the foot's rotation kept. Below 1 the leg reaches them.
double Reach(const Leg& leg, const JointPlacement& placement, const Eigen::Vector3d& toes);

/// Returns `toes`, or the nearest point at which Reach is at most `most` or, if that is larger, the
/// leg's present Reach.
Eigen::Vector3d WithinReach(const Leg& leg, const JointPlacement& placement,
                            const Eigen::Vector3d& toes, double most);

/// Turns hip and knee by PlaceEnd so that the toes reach `toes` (in the frame of `pose`) and the
/// foot keeps its global rotation. A straight knee bends forward. Returns the bend, radians.
double PlaceToes(const Leg& leg, const Skeleton& skeleton, const JointPlacement& placement,
                 const Eigen::Vector3d& toes, Pose* pose, const BendRange& range = {});

/// The knee's bend, as PlaceToes returns it.
double KneeBend(const Leg& leg, const JointPlacement& placement);

}  // namespace choreo
