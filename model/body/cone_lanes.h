#pragma once

#include <Eigen/Core>
#include <span>

#include "model/body/lanes.h"
#include "model/body/rounded_cone.h"

/// Questions to rounded cones, for kLanes of them or of rays or points at once. Thread-safe.
namespace choreo {

/// A shape in each lane.
struct ConeLanes {
  /// Fewer shapes than lanes: the last stands in the rest, too, where it hides nothing of the sky.
  /// At least one.
  explicit ConeLanes(std::span<const BoundedCone> cones);
  /// One in all lanes.
  explicit ConeLanes(const BoundedCone& cone);

  Lanes a, axis, middle;
  Lane axis2, radius_a, radius_b, mean_radius, bound2, sky_reach2;
};

/// Whether any of the rays of unit direction may enter one of the shapes: quicker than Enter.
bool MayEnter(const ConeLanes& cones, const Lanes& origins, const Lanes& directions);

/// How far along rays of unit direction the nearest points are where they enter the shapes; below
/// 0: nowhere.
Lane Enter(const ConeLanes& cones, const Lanes& origins, const Lanes& directions);

/// How much of a lamp of angular radius `spread` (radians) in the direction `light` the shapes hide
/// from the points, 0 to 1: an approximation that is exact in the middle of the shadow and outside.
Lane ShadowOf(const ConeLanes& cones, const Lanes& points, const Eigen::Vector3f& light,
              float spread);

/// How much of the sky above surfaces with these normals the shapes hide from the points, 0 to 1;
/// nothing where that is less than a hundredth (BoundedCone::SkyReach).
Lane HiddenSky(const ConeLanes& cones, const Lanes& points, const Lanes& normals);

}  // namespace choreo
