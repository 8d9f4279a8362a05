#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "model/fit/bones/human_bones.h"
#include "model/fit/sources/position_clip.h"
#include "model/motion/skeleton.h"

/// Maps the joints of source skeletons to ours.
namespace choreo {

/// A weighted sum of named joints; the weights sum to 1.
using JointBlend = std::vector<std::pair<std::string, double>>;

/// The median distance of two points over a clip.
double MedianDistance(const PositionClip& clip, const JointBlend& a, const JointBlend& b);

/// A point fixed to one of our joints.
struct OurPoint {
  std::string joint;
  double weight = 1;
  /// Offset in the joint's frame (at rest: x to the dancer's left, y up, z forward), metres. For
  /// points that are not joints, such as heels and temples, and for source joints that sit
  /// elsewhere in the body than our joint of that name.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

/// A point that both skeletons have: a joint, or a point between joints such as the middle of the
/// hips. Landmarks form a tree, whose root is the first.
struct Landmark {
  std::string name;
  JointBlend source;           ///< in terms of the source's joints
  std::vector<OurPoint> ours;  ///< in terms of our skeleton's joints; the weights sum to 1
  int parent = -1;             ///< index of an earlier landmark, -1 for the first
  /// True for a single bone: the target has the source's direction from the parent and our rest
  /// length. False for several bones between: the target is the source's vector, scaled by our rest
  /// length over the source's median length.
  bool rigid = true;
  double weight = 1;  ///< confidence, which multiplies the residual
};

/// A source skeleton's landmarks, for fitting.
struct SourceMapping {
  std::string name;
  std::vector<Landmark> landmarks;
  /// Standard deviation of the landmarks, metres. Smaller values fit more closely; larger ones give
  /// joint limits and smoothness more weight.
  double accuracy_m = 0.004;
  /// Source joints that touch the floor, for levelling and grounding.
  std::vector<std::string> feet;
};

/// The mapping of our own skeleton with all its joints, for models that predict positions. `hands`:
/// the weight of joints below the wrists.
SourceMapping IdentitySource(const Skeleton& skeleton, double hands = 1);

/// The mapping of a BVH clip by its joint names (human_bones.h). End sites have their parent's name
/// + "_end". Measures the spine's proportions in the clip. Throws Error(kInvalidArgument), naming
/// the first needed joint that is missing: hips, knees, ankles, shoulders, elbows, wrists, neck.
SourceMapping BvhSource(const PositionClip& clip);
/// The same for known bones.
SourceMapping RigSource(const PositionClip& clip, const HumanBones& bones);

inline constexpr double kTangAccuracy = 0.015;  ///< metres, of tang2018's points

/// The 23 joints of "Dance with Melody" (Tang et al. 2018) in file order, without the world centre
/// in row 0 of the .npy.
const std::vector<std::string>& Tang2018JointNames();
SourceMapping Tang2018Source();

/// The 21 joints of the same dancers as first published, in file order. The row called head is the
/// left temple. The heels' rows are midway between heel and toes. The neck lies two thirds of the
/// way from waist to temple, so it adds nothing.
const std::vector<std::string>& Tang61JointNames();
SourceMapping Tang61Source();

}  // namespace choreo
