#include "model/body/rounded_cone.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "model/body/cone_lanes.h"

namespace choreo::rounded_cone_test {

using Eigen::Vector3f;

// Exact distance to the convex hull of two balls: the smallest over the balls in between, found by
// search.
float SearchedDistance(const RoundedCone& cone, const Vector3f& point) {
  float nearest = 1e9f;
  for (int i = 0; i <= 400; ++i) {
    const float s = static_cast<float>(i) / 400;
    const Vector3f centre = cone.a + s * (cone.b - cone.a);
    const float radius = cone.radius_a + s * (cone.radius_b - cone.radius_a);
    nearest = std::min(nearest, (point - centre).norm() - radius);
  }
  return nearest;
}

float Distance(const RoundedCone& cone, const Vector3f& origin, const Vector3f& direction) {
  const ConeLanes cones{BoundedCone(cone)};
  const Lane distance = Enter(cones, Lanes::All(origin), Lanes::All(direction));
  for (int lane = 1; lane < kLanes; ++lane) EXPECT_EQ(distance[lane], distance[0]);
  const bool may = MayEnter(cones, Lanes::All(origin), Lanes::All(direction));
  EXPECT_TRUE(may || distance[0] < 0);
  return distance[0];
}

float Shadow(const RoundedCone& cone, const Vector3f& point, const Vector3f& light, float spread) {
  return ShadowOf(ConeLanes{BoundedCone(cone)}, Lanes::All(point), light, spread)[0];
}

float Hidden(const RoundedCone& cone, const Vector3f& point, const Vector3f& normal) {
  return HiddenSky(ConeLanes{BoundedCone(cone)}, Lanes::All(point), Lanes::All(normal))[0];
}

TEST(RoundedCone, RaysMeetTheSurfaceFirst) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto random = [&] {
    const float x = uniform(generator), y = uniform(generator), z = uniform(generator);
    return Vector3f(x, y, z);
  };
  int hits = 0, misses = 0;
  for (int i = 0; i < 400; ++i) {
    const RoundedCone cone{0.5f * random(), 0.5f * random(),
                           0.05f + 0.3f * std::abs(uniform(generator)),
                           0.05f + 0.3f * std::abs(uniform(generator))};
    const Vector3f origin = 3 * random().normalized();
    const Vector3f direction = (0.5f * random() - origin).normalized();
    const float hit = Distance(cone, origin, direction);
    // Marching by the distance never passes through the surface.
    float marched = 0, gap = 1;
    for (int step = 0; step < 300 && gap > 1e-4f && marched < 6; ++step) {
      gap = SearchedDistance(cone, origin + marched * direction);
      marched += gap;
    }
    if (hit < 0) {
      ++misses;
      EXPECT_GT(marched, 3);
      continue;
    }
    ++hits;
    const Vector3f point = origin + hit * direction;
    const Vector3f normal = NormalAt(cone, point);
    EXPECT_NEAR(SearchedDistance(cone, point), 0, 2e-4f);
    EXPECT_LT(normal.dot(direction), 1e-3f);
    EXPECT_NEAR(normal.norm(), 1, 1e-4f);
    // Out of the surface along the normal: the distance grows as fast.
    EXPECT_NEAR(SearchedDistance(cone, point + 0.01f * normal), 0.01f, 5e-4f);
    EXPECT_NEAR(hit, marched, 0.01f);
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 50);
}

TEST(RoundedCone, OneBallInsideTheOtherIsABall) {
  const RoundedCone cone{{0, 0, 0}, {0.1f, 0, 0}, 1, 0.2f};
  EXPECT_NEAR(Distance(cone, {5, 0, 0}, {-1, 0, 0}), 4, 1e-5f);
  EXPECT_LT(Distance(cone, {5, 1.01f, 0}, {-1, 0, 0}), 0);
  EXPECT_LT(Distance(cone, {5, 0, 0}, {1, 0, 0}), 0);  // behind
}

TEST(RoundedCone, LanesAreIndependent) {
  const BoundedCone near(RoundedCone{{0, 0.5f, 0}, {0, 1.5f, 0}, 0.1f, 0.1f});
  const BoundedCone far(RoundedCone{{3, 0.5f, 0}, {3, 1.5f, 0}, 0.2f, 0.1f});
  const std::vector<BoundedCone> both = {near, far};
  const ConeLanes cones{both};
  const Lanes origin = Lanes::All({-1, 0.6f, 0}), ahead = Lanes::All({1, 0, 0});
  const Lane distance = Enter(cones, origin, ahead);
  EXPECT_NEAR(distance[0], 0.9f, 1e-5f);
  EXPECT_GT(distance[1], 3.8f);
  for (int lane = 2; lane < kLanes; ++lane) EXPECT_EQ(distance[lane], distance[1]);
  // A shape that only fills lanes is not counted twice.
  const Lane hidden = HiddenSky(cones, Lanes::All({2.5f, 0.6f, 0}), ahead);
  EXPECT_GT(hidden[1], 0.1f);
  for (int lane = 2; lane < kLanes; ++lane) EXPECT_EQ(hidden[lane], 0);
  EXPECT_FALSE(MayEnter(cones, origin, Lanes::All({0, 1, 0})));
}

TEST(RoundedCone, ShadowsLieOppositeTheLamp) {
  const RoundedCone post{{0, 0.5f, 0}, {0, 1.5f, 0}, 0.1f, 0.1f};
  const Vector3f light = Vector3f(1, 1, 0).normalized();
  EXPECT_FLOAT_EQ(Shadow(post, {-1, 0, 0}, light, 0.02f), 1);
  EXPECT_FLOAT_EQ(Shadow(post, {1, 0, 0}, light, 0.02f), 0);
  EXPECT_FLOAT_EQ(Shadow(post, {-1, 0, 0.5f}, light, 0.02f), 0);
  EXPECT_NEAR(Shadow(post, {-1, 0, 0.1f}, light, 0.02f), 0.5f, 0.1f);
  EXPECT_GT(Hidden(post, {0.15f, 0, 0}, {0, 1, 0}), Hidden(post, {0.6f, 0, 0}, {0, 1, 0}));
  EXPECT_FLOAT_EQ(Hidden(post, {0, 0, 0}, {0, -1, 0}), 0);
}

}  // namespace choreo::rounded_cone_test
