#include "model/draw/doll_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <utility>

#include "model/draw/tone.h"

namespace choreo {
namespace {

using Eigen::Vector3f;

constexpr float kShadowBias =
    0.012f;  // metres above the surface, because parts overlap at the joints

std::vector<ConeLanes> InLanes(std::span<const BoundedCone> cones) {
  std::vector<ConeLanes> lanes;
  for (size_t i = 0; i < cones.size(); i += kLanes)
    lanes.emplace_back(cones.subspan(i, std::min<size_t>(kLanes, cones.size() - i)));
  return lanes;
}

}  // namespace

DollLight::DollLight(const std::vector<PlacedPart>& doll, const std::vector<BoundedCone>& parts,
                     const Vector3f& lamp)
    : lamp_(lamp) {
  for (size_t i = 0; i < parts.size(); ++i) {
    const float around = parts[i].radius + 2 * kShadowBias;
    std::vector<BoundedCone> shading, hiding;
    for (const BoundedCone& other : parts) {
      const Vector3f to = other.middle - parts[i].middle;
      if (&other == &parts[i]) continue;
      if (to.norm() < around + other.SkyReach()) hiding.push_back(other);
      if (to.cross(lamp_).norm() < around + other.radius &&
          to.dot(lamp_) > -(around + other.radius)) {
        shading.push_back(other);
      }
    }
    parts_.push_back(
        {Linear(doll[i].colour), SkinAround(doll, i), InLanes(shading), InLanes(hiding)});
  }
}

Vector3f DollLight::At(size_t index, const Vector3f& point, const Vector3f& own,
                       const Vector3f& ray) const {
  const Part& part = parts_[index];
  const Vector3f normal = SkinNormal(part.skin, point, own);
  const Vector3f start = point + kShadowBias * normal;
  const Lanes starts = Lanes::All(start), normals = Lanes::All(normal), to_lamp = Lanes::All(lamp_);
  float lamp = std::max(0.0f, normal.dot(lamp_));
  const auto shades = [&](const ConeLanes& cones) {
    return MayEnter(cones, starts, to_lamp) && Any(Enter(cones, starts, to_lamp) > 0);
  };
  if (lamp > 0 && std::ranges::any_of(part.shading, shades)) lamp = 0;
  Lane left = AllLanes(1);
  for (const ConeLanes& cones : part.hiding) left *= 1 - 0.7f * HiddenSky(cones, starts, normals);
  const float open = left[0] * left[1] * left[2] * left[3];
  const float sky = open * (0.5f + 0.5f * normal.y());
  // Light from the floor reaches feet more than heads.
  const float bounce = open * (0.5f - 0.5f * normal.y()) * 0.5f * (1 - SmoothStep(0, 2, point.y()));
  const float towards = std::max(0.0f, -normal.dot(ray));
  const float edge = (1 - towards) * (1 - towards) * (1 - towards);
  const float light = 0.68f * lamp + 0.34f * sky + 0.30f * bounce + 0.24f * open * towards;
  return light * part.colour + Vector3f::Constant(0.05f * edge * open);
}

}  // namespace choreo
