#pragma once

#include <vector>

#include "model/body/colour.h"
#include "model/body/doll.h"
#include "model/draw/picture.h"
#include "model/draw/view.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// How a frame is drawn.
struct FrameStyle {
  Colour background = Colour::Hex(0xfbf9f6);
  Colour floor = Colour::Hex(0xece6dc);
  int samples = 3;  ///< rays a pixel along each side of the body, 1 to 8
};

/// What frames a key pose.
inline constexpr Colour kKeyColour = Colour::Hex(0xd99a00);

/// Draws one pose, lit from the left above the camera, with its shadow on the floor y = 0, into a
/// picture whose width and height are set (1 to kMostPicturePixels); `picture.rgb` is resized. The
/// same input gives the same bytes. Throws Error(kInvalidArgument) for sizes, a view or a style
/// outside their limits, or a pose of another joint count or with values that are not finite.
/// Thread-safe.
void DrawFrame(const Skeleton& skeleton, const Pose& pose, const View& view,
               const FrameStyle& style, Picture& picture);
/// The same of all bodies on a stage (BuildFigure), one behind the other.
void DrawFrame(const std::vector<PlacedPart>& figures, const View& view, const FrameStyle& style,
               Picture& picture);

}  // namespace choreo
