#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/body/colour.h"
#include "model/body/rounded_cone.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// The body in our pictures and glTF files: a jointed doll of rounded cones.
namespace choreo {

/// Colours of the two sides of a body.
inline constexpr Colour kLeftColour = Colour::Hex(0xe8663d);
inline constexpr Colour kRightColour = Colour::Hex(0x2f7fa8);
inline constexpr Colour kTrunkColour = Colour::Hex(0xe6ddd0);
inline constexpr Colour kSkinColour = Colour::Hex(0xdfb08c);
inline constexpr Colour kHairColour = Colour::Hex(0x4b382e);

/// A ball fixed to a joint: `offset` in the joint's frame (at rest x to the left, y up, z forward)
/// and radius, metres.
struct DollBall {
  int joint;
  Eigen::Vector3d offset;
  double radius;
};

/// A part of the doll: the convex hull of two balls.
struct DollPart {
  DollBall a, b;
  Colour colour;
};

/// Builds the doll for a skeleton: left limbs in kLeftColour, right limbs in kRightColour, and a
/// head whose nose shows where it faces. A skeleton without all of SMPL's joints gets a capsule for
/// every bone, with a radius by its joints' roles.
std::vector<DollPart> MakeDoll(const Skeleton& skeleton);

/// A part of the doll, placed by a pose.
struct PlacedPart {
  RoundedCone shape;  ///< in the world
  Colour colour;
};

/// Places the doll's parts by joint placements, in the doll's order.
std::vector<PlacedPart> PlaceDoll(const std::vector<DollPart>& doll,
                                  const JointPlacement& placement);

/// The doll of a skeleton in a pose. Throws Error(kInvalidArgument) if the pose's joint count is
/// not the skeleton's.
std::vector<PlacedPart> BuildDoll(const Skeleton& skeleton, const Pose& pose);

/// The doll's height above the floor, metres: 0 if it touches the floor as at rest, negative if it
/// sinks in. Throws what BuildDoll throws.
double DollAboveFloor(const Skeleton& skeleton, const Pose& pose);

/// The parts that may form one piece of skin with part `index`: they have its colour and may meet
/// it.
std::vector<const PlacedPart*> SkinAround(const std::vector<PlacedPart>& parts, size_t index);

/// The normal of a part at `point` on its surface: its `own` normal, blended with the normals of
/// parts in `around` that it meets there.
Eigen::Vector3f SkinNormal(const std::vector<const PlacedPart*>& around,
                           const Eigen::Vector3f& point, const Eigen::Vector3f& own);

}  // namespace choreo
