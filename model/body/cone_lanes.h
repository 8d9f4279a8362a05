#pragma once

#include <Eigen/Core>
#include <span>

#include "model/body/lanes.h"
#include "model/body/rounded_cone.h"

/// Queries of rounded cones: kLanes cones, rays or points at once. Thread-safe.
namespace choreo {

/// One shape per lane.
struct ConeLanes {
  /// Takes 1 to kLanes shapes. The last fills the remaining lanes, where it hides no sky.
  explicit ConeLanes(std::span<const BoundedCone> cones);
  /// The same shape in all lanes.
  explicit ConeLanes(const BoundedCone& cone);

  Lanes a, axis, middle;
  Lane axis2, radius_a, radius_b, mean_radius, bound2, sky_reach2;
};

/// Whether any of the rays (unit direction) may enter one of the shapes: a quick test before Enter.
bool MayEnter(const ConeLanes& cones, const Lanes& origins, const Lanes& directions);

/// The distance along rays (unit direction) at which they enter the shapes; negative: never.
Lane Enter(const ConeLanes& cones, const Lanes& origins, const Lanes& directions);

/// How much of a lamp of angular radius `spread` (radians) in the direction `light` the shapes hide
/// from the points, 0 to 1. Approximate, but exact in the middle of the shadow and outside it.
Lane ShadowOf(const ConeLanes& cones, const Lanes& points, const Eigen::Vector3f& light,
              float spread);

/// How much of the sky above surfaces with these normals the shapes hide from the points, 0 to 1;
/// below a hundredth it is taken as 0 (BoundedCone::SkyReach).
Lane HiddenSky(const ConeLanes& cones, const Lanes& points, const Lanes& normals);

}  // namespace choreo
