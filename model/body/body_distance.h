#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "model/body/rounded_cone.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A moving body (doll.h), prepared for LeastDistance. Immutable.
class MovingBody {
 public:
  /// Throws like BuildDoll.
  MovingBody(const Skeleton& skeleton, const Motion& motion);

  int64_t frames() const { return std::ssize(frames_); }

 private:
  friend struct BodyDistance LeastDistance(const MovingBody& a, const MovingBody& b,
                                           const Eigen::Vector3d& moved);
  struct Frame {
    std::vector<BoundedCone> parts;
    Eigen::Vector3f middle;
    float radius;  // of a ball around the whole body, metres
  };
  std::vector<Frame> frames_;
};

/// The closest approach of two bodies.
struct BodyDistance {
  double metres = 0;  ///< distance of the surfaces; negative: the depth of overlap
  int64_t frame = 0;  ///< the first with that distance
};

/// The least distance of two moving bodies, the second displaced by `moved`, metres. Measures limbs
/// at the nearest points of their axes, which errs by at most the limb's taper there. Throws
/// Error(kInvalidArgument) if either has no frames. Thread-safe.
BodyDistance LeastDistance(const MovingBody& a, const MovingBody& b,
                           const Eigen::Vector3d& moved = Eigen::Vector3d::Zero());

}  // namespace choreo
