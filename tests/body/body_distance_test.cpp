#include "model/body/body_distance.h"

#include <gtest/gtest.h>

#include "model/body/doll.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"

namespace choreo::body_distance_test {

const Skeleton& kSmpl = Skeleton::Smpl24();

Motion Standing(size_t frames) {
  return {.fps = 30, .frames = std::vector<Pose>(frames, RestPose(kSmpl))};
}

/// How far the body reaches to a side, metres.
double Reach(double side) {
  double reach = 0;
  for (const PlacedPart& part : BuildDoll(kSmpl, RestPose(kSmpl))) {
    reach = std::max({reach, side * part.shape.a.x() + part.shape.radius_a,
                      side * part.shape.b.x() + part.shape.radius_b});
  }
  return reach;
}

TEST(BodyDistance, MeasuresHandsOfOutstretchedArms) {
  const MovingBody body(kSmpl, Standing(1));
  const double between = LeastDistance(body, body, {3, 0, 0}).metres;
  EXPECT_NEAR(between, 3 - Reach(1) - Reach(-1), 0.02);
  // One behind the other, they are as far apart as they stand, less noses and toes.
  EXPECT_NEAR(LeastDistance(body, body, {0, 0, 2}).metres, 1.7, 0.15);
  EXPECT_LT(LeastDistance(body, body, {0.5, 0, 0}).metres, 0);
}

TEST(BodyDistance, IsTheMinimumOverFrames) {
  Motion comes = Standing(9);
  for (size_t i = 0; i < 9; ++i) comes.frames[i].root_position.x() += i == 5 ? 2.5 : 4;
  const BodyDistance nearest =
      LeastDistance({kSmpl, Standing(20)}, {kSmpl, comes}, Eigen::Vector3d::Zero());
  EXPECT_EQ(nearest.frame, 5);
  EXPECT_NEAR(nearest.metres, 2.5 - Reach(1) - Reach(-1), 0.02);
  const MovingBody nobody(kSmpl, {});
  ExpectError(ErrorCode::kInvalidArgument, "0 frames", [&] { LeastDistance(nobody, nobody); });
}

}  // namespace choreo::body_distance_test
