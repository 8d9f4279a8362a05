#pragma once

#include <Eigen/Core>
#include <span>

#include "model/body/lanes.h"
#include "model/body/rounded_cone.h"

/// Geometric queries of rounded cones, kLanes cones, rays or points at once. Thread-safe.
namespace choreo {

/// kLanes cones, one per lane.
struct ConeLanes {
  /// Takes 1 to kLanes cones. Copies of the last one fill the other lanes, and hide no sky there.
  explicit ConeLanes(std::span<const BoundedCone> cones);
  /// The same cone in all lanes.
  explicit ConeLanes(const BoundedCone& cone);

  Lanes a, axis, middle;
  Lane axis2, radius_a, radius_b, mean_radius, bound2, sky_reach2;
};

/// Whether any of the rays (unit direction) may enter its cone: a quick test before Enter.
bool MayEnter(const ConeLanes& cones, const Lanes& origins, const Lanes& directions);

/// The distance along each ray (unit direction) at which it enters its cone; negative: never.
Lane Enter(const ConeLanes& cones, const Lanes& origins, const Lanes& directions);

/// The share of a lamp that the cones hide from the points, 0 to 1. The lamp is in direction
/// `light` with angular radius `spread` (radians). Approximate, but exact in the middle of the
/// shadow and outside it.
Lane ShadowOf(const ConeLanes& cones, const Lanes& points, const Eigen::Vector3f& light,
              float spread);

/// The share of the sky that the cones hide from points on surfaces with these normals, 0 to 1.
/// Less than a hundredth counts as 0 (BoundedCone::SkyReach).
Lane HiddenSky(const ConeLanes& cones, const Lanes& points, const Lanes& normals);

}  // namespace choreo
