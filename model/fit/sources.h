#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "model/fit/human_bones.h"
#include "model/fit/position_clip.h"
#include "model/motion/skeleton.h"

/// Says how the joints of source skeletons locate ours.
namespace choreo {

/// A weighted sum of named joints; the weights sum to 1.
using JointBlend = std::vector<std::pair<std::string, double>>;

/// Median distance of two points of a recorded dancer over the clip.
double MedianDistance(const PositionClip& clip, const JointBlend& a, const JointBlend& b);

/// A point fixed to one of our joints.
struct OurPoint {
  std::string joint;
  double weight = 1;
  /// Offset in the joint's frame (at rest: x to the dancer's left, y up, z forward), metres. It
  /// serves points that are not joints, such as heels and temples, and source joints at another
  /// place in the body than ours of the same name.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

/// A point that both skeletons have: a joint, or a place between joints such as the middle of the
/// hips. Landmarks form a tree whose root is the first.
struct Landmark {
  std::string name;
  JointBlend source;           ///< in terms of the source's joints
  std::vector<OurPoint> ours;  ///< in terms of our skeleton's joints; the weights sum to 1
  int parent = -1;             ///< index of an earlier landmark, -1 for the first
  /// true: the source's direction from the parent with our rest length (a bone). false: the
  /// source's vector, scaled by our rest length over the source's median length (several bones in
  /// between, so that the distance may change).
  bool rigid = true;
  double weight = 1;  ///< confidence: multiplies the residual
};

/// A source skeleton, as the fit needs it.
struct SourceMapping {
  std::string name;
  std::vector<Landmark> landmarks;
  /// Standard deviation of its landmarks, metres. Smaller values fit more closely; larger ones give
  /// joint limits and smoothness more weight.
  double accuracy_m = 0.004;
  /// Source joints that touch the floor (for levelling and grounding).
  std::vector<std::string> feet;
};

/// Our own skeleton with all joints given, for models that predict positions. `hands`: the weight
/// of joints below the wrists.
SourceMapping IdentitySource(const Skeleton& skeleton, double hands = 1);

/// A recorded BVH hierarchy, by its joint names (human_bones.h). End sites are named after their
/// parent + "_end". Measures the spine's proportions on the clip. Throws Error(kInvalidArgument)
/// naming the first missing joint of those needed: hips, knees, ankles, shoulders, elbows, wrists,
/// neck.
SourceMapping BvhSource(const PositionClip& clip);
/// The same for known bones.
SourceMapping RigSource(const PositionClip& clip, const HumanBones& bones);

inline constexpr double kTangAccuracy = 0.015;  ///< of tang2018's points, metres

/// "Dance with Melody" (Tang et al. 2018): 23 joints. `Tang2018JointNames` lists them in file
/// order, without the world centre in row 0 of the .npy.
const std::vector<std::string>& Tang2018JointNames();
SourceMapping Tang2018Source();

/// The same dancers as first published: 21 joints, listed in file order. The row called head is the
/// left temple, the heels' rows are midway between heel and toes, and the neck lies two thirds of
/// the way from the waist to the temple and so adds nothing.
const std::vector<std::string>& Tang61JointNames();
SourceMapping Tang61Source();

}  // namespace choreo
