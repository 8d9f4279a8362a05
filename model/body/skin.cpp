#include "model/body/skin.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

namespace choreo {
namespace {

using Eigen::Vector3f;

constexpr int kSegments = 24;      // around a capsule
constexpr int kRings = 6;          // from each tangent circle to its pole
constexpr double kOnJoint = 0.06;  // metres: an end this near to its joint is on it

// The joint that moves a part's far end.
int Carrier(const Skeleton& skeleton, const DollPart& part) {
  const DollBall& end = part.b;
  return end.joint != part.a.joint && end.offset.norm() < kOnJoint ? skeleton.parents[end.joint]
                                                                   : end.joint;
}

bool IsSame(const DollBall& one, const DollBall& other) {
  return one.joint == other.joint && one.offset == other.offset && one.radius == other.radius;
}

// Whether another part also ends with this ball, as thigh and shin both end with the knee.
bool IsShared(const std::vector<DollPart>& doll, const DollPart& part, const DollBall& ball) {
  return std::ranges::any_of(doll, [&](const DollPart& other) {
    return &other != &part && (IsSame(other.a, ball) || IsSame(other.b, ball));
  });
}

// A circle of latitude on one of a capsule's balls.
struct Ring {
  double latitude;  // radians, towards ball b
  bool at_b;
};

// `slope`: the sine of the tangent circles' latitude, which is beyond 1 if one ball contains the
// other.
std::vector<Ring> RingsOf(float slope) {
  constexpr double kPole = M_PI / 2;
  const bool nested = std::abs(slope) >= 1;
  const double tangent = nested ? (slope > 0 ? kPole : -kPole) : std::asin(double{slope});
  std::vector<Ring> rings;
  const auto add_rings = [&](double from, double to, bool at_b) {
    for (int i = 0; i <= kRings; ++i) {
      const double latitude = from + (to - from) * i / kRings;
      if (std::abs(latitude) < kPole - 1e-6) rings.push_back({latitude, at_b});
    }
  };
  if (!nested || slope > 0) add_rings(-kPole, tangent, false);
  if (!nested || slope < 0) add_rings(tangent, kPole, true);
  return rings;
}

// Adds the triangles between a pole, which is vertex `first`, `rings` rings, and the last vertex,
// the other pole.
void AddTriangles(SkinPatch& patch, uint32_t first, size_t rings) {
  const auto at = [&](size_t ring, int i) {
    return first + 1 + static_cast<uint32_t>(ring) * kSegments +
           static_cast<uint32_t>(i % kSegments);
  };
  const auto last = static_cast<uint32_t>(patch.positions.size()) - 1;
  for (int i = 0; i < kSegments; ++i) {
    patch.triangles.push_back({first, at(0, i + 1), at(0, i)});
    for (size_t ring = 0; ring + 1 < rings; ++ring) {
      patch.triangles.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)});
      patch.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)});
    }
    patch.triangles.push_back({at(rings - 1, i), at(rings - 1, i + 1), last});
  }
}

// Adds a capsule: a pole, rings of latitude over both balls, a pole. Balls and cone share their
// normals on the tangent circles, so no edge shows.
void AddCapsule(SkinPatch& patch, const RoundedCone& cone, int joint_a, int joint_b) {
  const Vector3f along = cone.b - cone.a;
  const float length = along.norm();
  const float slope = length > 0 ? (cone.radius_a - cone.radius_b) / length : 2;
  const bool nested = std::abs(slope) >= 1;  // one ball contains the other
  const Vector3f axis = nested ? Vector3f::UnitY() : (along / length).eval();
  // Two unit vectors that complete a right-handed frame.
  const Vector3f helper = std::abs(axis.y()) < 0.9f ? Vector3f::UnitY() : Vector3f::UnitX();
  const Vector3f u = helper.cross(axis).normalized();
  const Vector3f v = axis.cross(u);
  const auto first = static_cast<uint32_t>(patch.positions.size());
  const std::vector<Ring> rings = RingsOf(slope);
  const auto vertex = [&](const Vector3f& normal, bool at_b) {
    const Vector3f& centre = at_b ? cone.b : cone.a;
    patch.positions.push_back(centre + (at_b ? cone.radius_b : cone.radius_a) * normal);
    patch.normals.push_back(normal);
    patch.joints.push_back(static_cast<uint16_t>(at_b ? joint_b : joint_a));
  };
  vertex(-axis, rings.front().at_b);
  for (const Ring& ring : rings) {
    const auto across = static_cast<float>(std::cos(ring.latitude));
    const auto up = static_cast<float>(std::sin(ring.latitude));
    for (int i = 0; i < kSegments; ++i) {
      const double angle = 2 * M_PI * i / kSegments;
      const Vector3f radial =
          static_cast<float>(std::cos(angle)) * u + static_cast<float>(std::sin(angle)) * v;
      vertex((across * radial + up * axis).normalized(), ring.at_b);
    }
  }
  vertex(axis, rings.back().at_b);
  AddTriangles(patch, first, rings.size());
}

}  // namespace

std::vector<SkinPatch> MakeSkin(const Skeleton& skeleton) {
  const std::vector<DollPart> doll = MakeDoll(skeleton);
  const std::vector<PlacedPart> parts =
      PlaceDoll(doll, ForwardKinematics(skeleton, RestPose(skeleton)));
  std::vector<SkinPatch> patches;
  for (size_t i = 0; i < parts.size(); ++i) {
    auto patch = std::ranges::find(patches, parts[i].colour, &SkinPatch::colour);
    if (patch == patches.end()) {
      patch = patches.insert(patches.end(), SkinPatch{});
      patch->colour = parts[i].colour;
    }
    const size_t first = patch->positions.size();
    AddCapsule(*patch, parts[i].shape, doll[i].a.joint, Carrier(skeleton, doll[i]));
    const std::vector<const PlacedPart*> around = SkinAround(parts, i);
    // Two bones that share a ball move relative to each other and overlap there. Both take the
    // ball's round normals; otherwise the shading of each at rest would show through.
    std::vector<const PlacedPart*> of_bone;
    std::ranges::copy_if(around, std::back_inserter(of_bone), [&](const PlacedPart* other) {
      const DollPart& part = doll[other - parts.data()];
      return part.a.joint == doll[i].a.joint &&
             Carrier(skeleton, part) == Carrier(skeleton, doll[i]);
    });
    const auto& [shape, colour] = parts[i];
    const bool is_a_shared = IsShared(doll, doll[i], doll[i].a);
    const bool is_b_shared = IsShared(doll, doll[i], doll[i].b);
    for (size_t vertex = first; vertex < patch->positions.size(); ++vertex) {
      const Vector3f& point = patch->positions[vertex];
      Vector3f& normal = patch->normals[vertex];
      const bool is_at_b = (point - shape.radius_b * normal - shape.b).norm() <
                           (point - shape.radius_a * normal - shape.a).norm();
      normal = SkinNormal((is_at_b ? is_b_shared : is_a_shared) ? of_bone : around, point, normal);
    }
  }
  return patches;
}

}  // namespace choreo
