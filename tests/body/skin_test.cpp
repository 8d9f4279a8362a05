#include "model/body/skin.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <string_view>
#include <utility>

#include "model/motion/rotation.h"
#include "tests/motion/motion_fixtures.h"

namespace choreo::skin_test {

using Eigen::Vector3f;

const Skeleton& kSmpl = Skeleton::Smpl24();

// How far a point is from the nearest part's surface; below zero inside.
float Distance(const std::vector<PlacedPart>& parts, const Colour& colour, const Vector3f& point) {
  float nearest = 10;
  for (const PlacedPart& part : parts) {
    if (!(part.colour == colour)) continue;
    const RoundedCone& cone = part.shape;
    // The distance from a hull of two balls is the least over the balls between them.
    for (int i = 0; i <= 200; ++i) {
      const float s = static_cast<float>(i) / 200;
      const Vector3f centre = cone.a + s * (cone.b - cone.a);
      const float radius = cone.radius_a + s * (cone.radius_b - cone.radius_a);
      nearest = std::min(nearest, (point - centre).norm() - radius);
    }
  }
  return nearest;
}

TEST(Skin, AtRestIsTheDoll) {
  const std::vector<PlacedPart> parts = BuildDoll(kSmpl, RestPose(kSmpl));
  const std::vector<SkinPatch> skin = MakeSkin(kSmpl);
  EXPECT_EQ(skin.size(), 5u);  // left, right, trunk, skin, hair
  for (const SkinPatch& patch : skin) {
    ASSERT_EQ(patch.normals.size(), patch.positions.size());
    ASSERT_EQ(patch.joints.size(), patch.positions.size());
    for (size_t i = 0; i < patch.positions.size(); i += 7) {
      // On the surface, or inside where parts overlap.
      EXPECT_LT(Distance(parts, patch.colour, patch.positions[i]), 2e-4f);
      EXPECT_NEAR(patch.normals[i].norm(), 1, 1e-5);
      EXPECT_LT(patch.joints[i], kSmpl.joints());
    }
  }
}

TEST(Skin, IsClosedAndFacesOutward) {
  for (const SkinPatch& patch : MakeSkin(kSmpl)) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    double volume = 0;
    for (const auto& triangle : patch.triangles) {
      Vector3f corner[3];
      for (int i = 0; i < 3; ++i) {
        ASSERT_LT(triangle[i], patch.positions.size());
        corner[i] = patch.positions[triangle[i]];
        ++edges[{triangle[i], triangle[(i + 1) % 3]}];
      }
      volume += corner[0].dot(corner[1].cross(corner[2])) / 6;
    }
    // Each edge is used once in each direction.
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
    EXPECT_GT(volume, 1e-4);
  }
}

TEST(Skin, StaysOnTheDollWhenTheBodyBends) {
  std::mt19937 generator(9);
  const JointPlacement rest = ForwardKinematics(kSmpl, RestPose(kSmpl));
  const std::vector<SkinPatch> skin = MakeSkin(kSmpl);
  for (int i = 0; i < 5; ++i) {
    Pose pose = fixtures::RandomPose(kSmpl, generator, 1.0);
    // Trunk and collars bend as far as they do in people.
    for (const char* joint : {"spine1", "spine2", "spine3", "neck", "left_collar", "right_collar"})
      pose.rotations.col(kSmpl.Find(joint)) *= 0.3;
    const JointPlacement now = ForwardKinematics(kSmpl, pose);
    const std::vector<PlacedPart> parts = BuildDoll(kSmpl, pose);
    for (const SkinPatch& patch : skin) {
      const bool limb = patch.colour == kLeftColour || patch.colour == kRightColour;
      for (size_t v = 0; v < patch.positions.size(); v += 11) {
        const int joint = patch.joints[v];
        const Eigen::Vector3d moved =
            now.positions.col(joint) +
            now.rotations[joint] * (patch.positions[v].cast<double>() - rest.positions.col(joint));
        // Calf and heel end beside a joint whose rotation they do not follow.
        EXPECT_LT(Distance(parts, patch.colour, moved.cast<float>()), limb ? 0.02f : 0.05f)
            << kSmpl.joint_names[joint];
      }
    }
  }
}

// Thigh and shin both show there, however they turn: they must have the same shade.
TEST(Skin, ABallThatTwoBonesShareIsRound) {
  const JointPlacement rest = ForwardKinematics(kSmpl, RestPose(kSmpl));
  const std::vector<SkinPatch> skin = MakeSkin(kSmpl);
  for (const auto& [joint, radius] : {std::pair("left_knee", 0.056f),
                                      {"right_knee", 0.056f},
                                      {"left_elbow", 0.040f},
                                      {"right_elbow", 0.040f}}) {
    const Vector3f centre = rest.positions.col(kSmpl.Find(joint)).cast<float>();
    const Colour& colour = std::string_view(joint).starts_with("left") ? kLeftColour : kRightColour;
    int count = 0;
    for (const SkinPatch& patch : skin) {
      if (!(patch.colour == colour)) continue;
      for (size_t i = 0; i < patch.positions.size(); ++i) {
        const Vector3f radial = patch.positions[i] - centre;
        if (std::abs(radial.norm() - radius) > 1e-5f) continue;
        EXPECT_GT(patch.normals[i].dot(radial.normalized()), 0.999f) << joint;
        ++count;
      }
    }
    EXPECT_GT(count, 200) << joint;
  }
}

}  // namespace choreo::skin_test
