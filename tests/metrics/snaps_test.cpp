#include "model/metrics/groove.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/motion/kinematics/kinematics.h"

namespace choreo::snaps_test {

// With limbs straight at rest; SMPL's are not quite.
Skeleton StraightBody() {
  Skeleton body = Skeleton::Smpl24();
  for (const Hinge& hinge : Hinges(body)) {
    for (int joint = 0; joint < body.joints(); ++joint) {
      if (body.parents[static_cast<size_t>(joint)] != hinge.joint) continue;
      body.offsets.col(joint) =
          body.offsets.col(joint).norm() * body.offsets.col(hinge.joint).normalized();
    }
  }
  return body;
}

const Skeleton& Body() {
  static const Skeleton body = StraightBody();
  return body;
}

Pose Bent(const Hinge& hinge, double degrees) {
  Pose pose = RestPose(Body());
  pose.rotations.col(hinge.joint) = degrees * M_PI / 180 * hinge.axis;
  return pose;
}

Snaps SnapsOf(int which, const std::vector<double>& degrees, double fps = 30) {
  const Hinge hinge = Hinges(Body())[static_cast<size_t>(which)];
  std::vector<Pose> poses;
  for (const double angle : degrees) poses.push_back(Bent(hinge, angle));
  return CountSnaps(Body(), fps, TrackJoints(Body(), poses));
}

TEST(Snaps, AreFastStepsFromOrToAStraightLimb) {
  // Into it, out of it, both.
  EXPECT_EQ(SnapsOf(0, {12.5, 4.2}).knees, 1);
  EXPECT_EQ(SnapsOf(1, {4.2, 12.5}).knees, 1);
  EXPECT_EQ(SnapsOf(1, {20, 4, 20, 21}).knees, 2);
  // At rest the other hinges stand still.
  EXPECT_EQ(SnapsOf(0, {12.5, 4.2}).elbows, 0);
  EXPECT_EQ(SnapsOf(2, {12.5, 4.2}).elbows, 1);
  EXPECT_EQ(SnapsOf(3, {4.2, 12.5, 12.5}).elbows, 1);
  EXPECT_EQ(SnapsOf(3, {4.2, 12.5}).knees, 0);
}

TEST(Snaps, ExcludeSlowStepsAndBentLimbs) {
  EXPECT_EQ(SnapsOf(0, {4.2, 11.8, 19, 11.8, 4.2}).knees, 0);  // 7.6 degrees a frame
  EXPECT_EQ(SnapsOf(0, {5.5, 40, 5.5}).knees, 0);
  EXPECT_EQ(SnapsOf(0, {4.5}).knees, 0);
}

// The limit is of speed: at twice the rate a step is half as long.
TEST(Snaps, CountAlikeAtAnyFrameRate) {
  EXPECT_EQ(SnapsOf(0, {4.2, 8.7}, 60).knees, 1);
  EXPECT_EQ(SnapsOf(0, {4.2, 8.7}, 30).knees, 0);
  EXPECT_EQ(SnapsOf(0, {4.2, 19}, 15).knees, 0);
}

TEST(Snaps, WithoutElbowsCountKneesAlone) {
  Skeleton armless = Body();
  armless.left_elbow = armless.right_elbow = -1;
  const Hinge knee = Hinges(Body())[0];
  const std::vector<Pose> poses = {Bent(knee, 20), Bent(knee, 4)};
  const Snaps snaps = CountSnaps(armless, 30, TrackJoints(armless, poses));
  EXPECT_EQ(snaps.knees, 1);
  EXPECT_EQ(snaps.elbows, 0);
}

}  // namespace choreo::snaps_test
