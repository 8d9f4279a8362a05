#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/body/rounded_cone.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A moving body (doll.h), prepared frame by frame for measuring its distance from another.
class MovingBody {
 public:
  /// Throws like BuildFigure.
  MovingBody(const Skeleton& skeleton, const Motion& motion);

  int64_t frames() const { return std::ssize(frames_); }

 private:
  friend struct BodyDistance LeastDistance(const MovingBody& a, const MovingBody& b,
                                           const Eigen::Vector3d& moved);
  struct Frame {
    std::vector<BoundedCone> parts;
    Eigen::Vector3f middle;
    float radius;  // of a ball around the whole body
  };
  std::vector<Frame> frames_;
};

/// How near two bodies come.
struct BodyDistance {
  double metres = 0;  ///< between their surfaces; negative: the depth of overlap
  int64_t frame = 0;  ///< the first with that distance
};

/// The least distance of two moving bodies, the second displaced by `moved`, metres. Between limbs
/// it is taken at the nearest points of their axes, which errs by at most the limb's taper there.
/// Throws Error(kInvalidArgument) if either has no frames. Thread-safe.
BodyDistance LeastDistance(const MovingBody& a, const MovingBody& b,
                           const Eigen::Vector3d& moved = Eigen::Vector3d::Zero());

}  // namespace choreo
