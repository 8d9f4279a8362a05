#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/body/colour.h"
#include "model/body/rounded_cone.h"
#include "model/motion/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// The body that we show, in pictures and in glTF files: a jointed doll of rounded cones.
namespace choreo {

/// What tells the two sides of a body apart.
inline constexpr Colour kLeftColour = Colour::Hex(0xe8663d);
inline constexpr Colour kRightColour = Colour::Hex(0x2f7fa8);
inline constexpr Colour kTrunkColour = Colour::Hex(0xe6ddd0);
inline constexpr Colour kSkinColour = Colour::Hex(0xdfb08c);
inline constexpr Colour kHairColour = Colour::Hex(0x4b382e);

/// A ball that moves with a joint: `offset` in the joint's frame (at rest x to the left, y up, z
/// forward) and radius, metres.
struct DollBall {
  int joint;
  Eigen::Vector3d offset;
  double radius;
};

/// The hull of two balls.
struct DollPart {
  DollBall a, b;
  Colour colour;
};

/// A body for a skeleton: left limbs in kLeftColour, right limbs in kRightColour, and a head with a
/// nose that shows where it looks. A skeleton that lacks joints of SMPL's gets a capsule for every
/// bone instead, as thick as its joints' roles say.
std::vector<DollPart> MakeDoll(const Skeleton& skeleton);

/// A part of the doll where a pose has it.
struct PlacedPart {
  RoundedCone shape;  ///< in the world
  Colour colour;
};

/// Where the doll's parts are when its joints are there, in the doll's order.
std::vector<PlacedPart> PlaceDoll(const std::vector<DollPart>& doll,
                                  const JointPlacement& placement);

/// The doll of a skeleton in a pose. Throws Error(kInvalidArgument) if the pose's joint count is
/// not the skeleton's.
std::vector<PlacedPart> BuildFigure(const Skeleton& skeleton, const Pose& pose);

/// How far the doll of a pose is above the floor, metres: 0 where it touches the floor as at rest,
/// below 0 where a part of it would be under the floor. Errors as BuildFigure.
double DollAboveFloor(const Skeleton& skeleton, const Pose& pose);

/// Parts of one colour are one piece of skin: those that the part `index` may meet.
std::vector<const PlacedPart*> SkinAround(const std::vector<PlacedPart>& parts, size_t index);

/// The normal of a part at `point` on its surface, which alone would be `own`, blended with those
/// of the parts that it meets there, of `around`.
Eigen::Vector3f SkinNormal(const std::vector<const PlacedPart*>& around,
                           const Eigen::Vector3f& point, const Eigen::Vector3f& own);

}  // namespace choreo
