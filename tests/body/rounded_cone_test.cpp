#include "model/body/rounded_cone.h"

#include <gtest/gtest.h>

#include <random>

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
    const RayHit hit = Intersect(cone, origin, direction);
    // March by the distance, which never goes through the surface.
    float marched = 0, gap = 1;
    for (int step = 0; step < 300 && gap > 1e-4f && marched < 6; ++step) {
      gap = SearchedDistance(cone, origin + marched * direction);
      marched += gap;
    }
    if (hit.distance < 0) {
      ++misses;
      EXPECT_GT(marched, 3);
      continue;
    }
    ++hits;
    const Vector3f point = origin + hit.distance * direction;
    EXPECT_NEAR(SearchedDistance(cone, point), 0, 2e-4f);
    EXPECT_LT(hit.normal.dot(direction), 1e-3f);
    EXPECT_NEAR(hit.normal.norm(), 1, 1e-4f);
    // Out of the surface along the normal: the distance grows as fast.
    EXPECT_NEAR(SearchedDistance(cone, point + 0.01f * hit.normal), 0.01f, 5e-4f);
    EXPECT_NEAR(hit.distance, marched, 0.01f);
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 50);
}

TEST(RoundedCone, OneBallInsideTheOtherIsABall) {
  const RoundedCone cone{{0, 0, 0}, {0.1f, 0, 0}, 1, 0.2f};
  EXPECT_NEAR(Intersect(cone, {5, 0, 0}, {-1, 0, 0}).distance, 4, 1e-5f);
  EXPECT_LT(Intersect(cone, {5, 1.01f, 0}, {-1, 0, 0}).distance, 0);
  EXPECT_LT(Intersect(cone, {5, 0, 0}, {1, 0, 0}).distance, 0);  // behind
}

TEST(RoundedCone, ShadowsLieOppositeTheLamp) {
  const RoundedCone post{{0, 0.5f, 0}, {0, 1.5f, 0}, 0.1f, 0.1f};
  const Vector3f light = Vector3f(1, 1, 0).normalized();
  EXPECT_FLOAT_EQ(ShadowOf(post, {-1, 0, 0}, light, 0.02f), 1);
  EXPECT_FLOAT_EQ(ShadowOf(post, {1, 0, 0}, light, 0.02f), 0);
  EXPECT_FLOAT_EQ(ShadowOf(post, {-1, 0, 0.5f}, light, 0.02f), 0);
  EXPECT_NEAR(ShadowOf(post, {-1, 0, 0.1f}, light, 0.02f), 0.5f, 0.1f);
  EXPECT_GT(OcclusionBy(post, {0.15f, 0, 0}, {0, 1, 0}),
            OcclusionBy(post, {0.6f, 0, 0}, {0, 1, 0}));
  EXPECT_FLOAT_EQ(OcclusionBy(post, {0, 0, 0}, {0, -1, 0}), 0);
}

}  // namespace choreo::rounded_cone_test
