#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/body/rounded_cone.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// The body of a motion (doll.h), frame by frame, to be measured against another.
class MovingBody {
 public:
  /// Throws as BuildFigure.
  MovingBody(const Skeleton& skeleton, const Motion& motion);

  int64_t frames() const { return std::ssize(frames_); }

 private:
  friend struct BodyDistance LeastDistance(const MovingBody& a, const MovingBody& b,
                                           const Eigen::Vector3d& moved);
  struct Frame {
    std::vector<BoundedCone> parts;
    Eigen::Vector3f middle;
    float radius;  // of a ball around all of it
  };
  std::vector<Frame> frames_;
};

/// How near two bodies come.
struct BodyDistance {
  double metres = 0;  ///< between their surfaces; below zero: so deep one is in the other
  int64_t frame = 0;  ///< the first in which that is so
};

/// The least distance of two bodies while both move, where the second is elsewhere by `moved`,
/// metres. Between limbs it is that of the nearest points of their axes, which is the surfaces' to
/// within what a limb tapers there. Throws Error(kInvalidArgument) where one has no frames.
/// Thread-safe.
BodyDistance LeastDistance(const MovingBody& a, const MovingBody& b,
                           const Eigen::Vector3d& moved = Eigen::Vector3d::Zero());

}  // namespace choreo
