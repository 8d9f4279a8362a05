#pragma once

#include <vector>

#include "model/body/colour.h"
#include "model/body/doll.h"
#include "model/draw/picture.h"
#include "model/draw/view.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// How to draw a frame.
struct FrameStyle {
  Colour background = Colour::Hex(0xfbf9f6);
  Colour floor = Colour::Hex(0xece6dc);
  int samples = 3;  ///< rays per pixel on each side of the body, 1 to 8
};

/// The colour of the frame around a key pose.
inline constexpr Colour kKeyColour = Colour::Hex(0xd99a00);

/// Draws one pose, lit from the upper left of the camera, with its shadow on the floor y = 0.
/// `picture` has its width and height set (1 to kMaxPicturePixels); its `rgb` is resized.
/// Deterministic. Throws Error(kInvalidArgument) for sizes, a view or a style outside their limits,
/// or a pose with another joint count or values that are not finite. Thread-safe.
void DrawFrame(const Skeleton& skeleton, const Pose& pose, const View& view,
               const FrameStyle& style, Picture& picture);
/// The same for several bodies, given by the parts of their dolls (BuildDoll).
void DrawFrame(const std::vector<PlacedPart>& dolls, const View& view, const FrameStyle& style,
               Picture& picture);

}  // namespace choreo
