#include "model/body/cone_lanes.h"

#include <algorithm>
#include <limits>

#include "model/core/numbers/smooth_step.h"

namespace choreo {
namespace {

constexpr float kMinDistance = 1e-4f;  // keeps a ray from hitting the surface that it starts on

}  // namespace

ConeLanes::ConeLanes(std::span<const BoundedCone> cones) {
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto at = std::min(static_cast<size_t>(lane), cones.size() - 1);
    const RoundedCone& shape = cones[at].shape;
    const Eigen::Vector3f along = shape.b - shape.a;
    a.Put(lane, shape.a), axis.Put(lane, along), middle.Put(lane, cones[at].middle);
    axis2[lane] = along.squaredNorm();
    radius_a[lane] = shape.radius_a;
    radius_b[lane] = shape.radius_b;
    mean_radius[lane] = 0.5f * (shape.radius_a + shape.radius_b);
    bound2[lane] = cones[at].radius * cones[at].radius;
    const float reach = static_cast<size_t>(lane) == at ? cones[at].SkyReach() : 0;
    sky_reach2[lane] = reach * reach;
  }
}

ConeLanes::ConeLanes(const BoundedCone& cone) : ConeLanes(std::span(&cone, 1)) {
  sky_reach2 = AllLanes(cone.SkyReach() * cone.SkyReach());
}

bool MayEnter(const ConeLanes& cones, const Lanes& origins, const Lanes& directions) {
  const Lanes to = cones.middle - origins;
  const Lane along = Dot(to, directions), away2 = Dot(to, to);
  return Any(away2 - along * along < cones.bound2 && (along > 0 || away2 < cones.bound2));
}

// The mantle is the surface between the balls: points at distance radius from the axis, measured
// along the slanted normal. It is a quadric in the ray's distance, and ends where the balls begin,
// at the axis coordinates (times the axis length) s = 0 and s = taper. The shape is convex, so the
// ray enters at the nearest hit of any part.
Lane Enter(const ConeLanes& cones, const Lanes& origins, const Lanes& directions) {
  const Lanes from = origins - cones.a;
  const Lane slope = cones.radius_a - cones.radius_b;
  const Lane taper = cones.axis2 - slope * slope;
  const Lane axis_from = Dot(cones.axis, from), axis_ray = Dot(cones.axis, directions);
  const Lane ray_from = Dot(directions, from);
  const Lane k0 = taper * Dot(from, from) - axis_from * axis_from +
                  2 * axis_from * slope * cones.radius_a -
                  cones.axis2 * cones.radius_a * cones.radius_a;
  const Lane k1 = taper * ray_from - axis_from * axis_ray + axis_ray * slope * cones.radius_a;
  const Lane k2 = taper - axis_ray * axis_ray;
  const Lane square = k1 * k1 - k0 * k2;
  // A ray that misses the mantle's cone misses the balls, too. If taper is not positive, one ball
  // contains the other.
  const auto misses = taper > 0 && square < 0;
  if (!Any(!misses)) return AllLanes(-1);

  constexpr float kNone = std::numeric_limits<float>::infinity();
  Lane nearest = AllLanes(kNone);
  const auto meet = [&](Lane along, const auto& is_there) {
    nearest = is_there && along > kMinDistance && along < nearest ? along : nearest;
  };
  const Lane root = Sqrt(Max(square, 0));
  for (const Lane along : {(-root - k1) / k2, (root - k1) / k2}) {
    const Lane s = axis_from - cones.radius_a * slope + along * axis_ray;
    meet(along, s > 0 && s < taper);
  }
  const auto meet_ball = [&](const Lanes& from_centre, Lane along, Lane radius) {
    const Lane half2 = along * along - Dot(from_centre, from_centre) + radius * radius;
    meet(-along - Sqrt(Max(half2, 0)), half2 >= 0);
  };
  meet_ball(from, ray_from, cones.radius_a);
  meet_ball(from - cones.axis, ray_from - axis_ray, cones.radius_b);
  return nearest == kNone || misses ? AllLanes(-1) : nearest;
}

Lane ShadowOf(const ConeLanes& cones, const Lanes& points, const Eigen::Vector3f& light,
              float spread) {
  // The nearest points of the ray to the light and the axis.
  const Lanes to_light = Lanes::All(light), to_a = cones.a - points;
  const Lane axis_light = Dot(cones.axis, to_light);
  const Lane determinant = cones.axis2 - axis_light * axis_light;
  const Lane nearest = (axis_light * Dot(to_a, to_light) - Dot(cones.axis, to_a)) / determinant;
  const Lane s = determinant > 1e-9f ? Within01(nearest) : AllLanes(0.5f);
  const Lanes to_axis = to_a + s * cones.axis;
  const Lane distance = Dot(to_axis, to_light);
  const Lanes beside = to_axis - distance * to_light;
  const Lane radius = cones.radius_a + s * (cones.radius_b - cones.radius_a);
  const Lane gap = Sqrt(Dot(beside, beside)) - radius;
  const Lane cover = Within01(0.5f - 0.5f * gap / Max(distance * spread, 0.012f));
  return distance > 0 ? SmoothStep(cover) : AllLanes(0);
}

Lane HiddenSky(const ConeLanes& cones, const Lanes& points, const Lanes& normals) {
  const Lanes from_middle = points - cones.middle;
  const auto is_near = Dot(from_middle, from_middle) < cones.sky_reach2;
  if (!Any(is_near)) return AllLanes(0);
  const Lanes from_a = points - cones.a;
  const Lane s = Within01(Dot(cones.axis, from_a) / Max(cones.axis2, 1e-9f));
  const Lanes from_axis = from_a - s * cones.axis;
  const Lane distance = Sqrt(Dot(from_axis, from_axis));
  const Lane radius = cones.radius_a + s * (cones.radius_b - cones.radius_a);
  const Lane part = cones.mean_radius / (cones.mean_radius + Max(distance - radius, 0));
  const Lane facing = Max(-Dot(normals, from_axis) / Max(distance, 1e-6f), 0);
  return is_near ? facing * part * part : AllLanes(0);
}

}  // namespace choreo
