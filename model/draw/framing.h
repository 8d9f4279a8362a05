#pragma once

#include <vector>

#include "model/draw/view.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Views in which a dancer fits into the picture, her feet near its lower edge.
namespace choreo {

/// A pose and the place on the floor that comes to the middle of its picture, metres.
struct FramedPose {
  const Pose* pose;
  double x, z;
};

/// What the height of pictures of this aspect (width over height) must show so that every one of
/// the poses fits in, metres, 2 to 4.
double FitExtent(const Skeleton& skeleton, const std::vector<FramedPose>& poses, double aspect);

/// The view of one of them.
View StandingView(const FramedPose& framed, double azimuth, double extent);

}  // namespace choreo
