#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "model/fit/human_bones.h"
#include "model/fit/position_clip.h"
#include "model/motion/skeleton.h"

/// How the joints of source skeletons tell where ours are.
namespace choreo {

/// A weighted sum of named joints; the weights sum to 1.
using JointBlend = std::vector<std::pair<std::string, double>>;

/// Of two points of a recorded dancer, over the clip's frames.
double MedianDistance(const PositionClip& clip, const JointBlend& a, const JointBlend& b);

/// A point that moves with a joint of ours.
struct OurPoint {
  std::string joint;
  double weight = 1;
  /// From the joint, in its frame (at rest: x to the dancer's left, y up, z forward), metres. For
  /// points that are no joints, such as heels and temples, and where a source's joint stands
  /// elsewhere in the body than ours of the same name.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

/// A point that both skeletons have: a joint, or a place between joints such as the middle of the
/// hips. Landmarks form a tree; the first one is its root.
struct Landmark {
  std::string name;
  JointBlend source;           ///< in terms of the source's joints
  std::vector<OurPoint> ours;  ///< in terms of our skeleton's joints; the weights sum to 1
  int parent = -1;             ///< index of an earlier landmark, -1 for the first
  /// true: the source's direction from the parent with our rest length (a bone). false: the
  /// source's vector scaled by the ratio of our rest length to the source's median one (several
  /// bones in between, so that the distance may change).
  bool rigid = true;
  double weight = 1;  ///< confidence: multiplies the residual
};

/// A source skeleton as the fit sees it.
struct SourceMapping {
  std::string name;
  std::vector<Landmark> landmarks;
  /// How far its landmarks may be wrong, metres: standard deviation. The smaller, the closer the
  /// fit; the larger, the more say have the joints' limits and smoothness.
  double accuracy_m = 0.004;
  /// Source joints that touch the floor (for levelling and grounding).
  std::vector<std::string> feet;
};

/// Our own skeleton, every joint given: what a model that predicts positions uses. `hands` is the
/// weight of joints below the wrists.
SourceMapping IdentitySource(const Skeleton& skeleton, double hands = 1);

/// A recording of a BVH hierarchy, by its joint names (human_bones.h). End sites are named after
/// their parent + "_end". The spine's proportions are measured on the clip. Throws
/// Error(kInvalidArgument) naming the first joint of those needed that is missing: hips, knees,
/// ankles, shoulders, elbows, wrists, neck.
SourceMapping BvhSource(const PositionClip& clip);
/// The same, where it is known which of the clip's joints is which bone.
SourceMapping RigSource(const PositionClip& clip, const HumanBones& bones);

inline constexpr double kTangAccuracy = 0.015;  ///< of tang2018's points, metres

/// "Dance with Melody" (Tang et al. 2018): 23 joints. `Tang2018JointNames` names them in file order
/// (row 0 of the .npy, the world centre, is not among them).
const std::vector<std::string>& Tang2018JointNames();
SourceMapping Tang2018Source();

/// The same dancers as they were first published: 21 joints, named in file order. The row that is
/// called head is the left temple, the heels' rows are the middles between heel and toes, and the
/// neck lies two thirds of the way from the waist to the temple, so that it tells nothing.
const std::vector<std::string>& Tang61JointNames();
SourceMapping Tang61Source();

}  // namespace choreo
