#pragma once

#include <vector>

#include "model/draw/colour.h"
#include "model/draw/rounded_cone.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// What tells the two sides of a body apart in pictures.
inline constexpr Colour kLeftColour = Colour::Hex(0xe8663d);
inline constexpr Colour kRightColour = Colour::Hex(0x2f7fa8);

struct BodyPart {
  RoundedCone shape;
  Colour colour;
};

/// A pose as a jointed doll: left limbs in kLeftColour, right limbs in kRightColour, and a head
/// with a nose that shows where it looks. A skeleton that lacks joints of SMPL's gets a stick for
/// every bone instead. Throws Error(kInvalidArgument) if the pose's joint count is not the
/// skeleton's.
std::vector<BodyPart> BuildFigure(const Skeleton& skeleton, const Pose& pose);

}  // namespace choreo
