#include "model/fit/retarget.h"

#include <gtest/gtest.h>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/skeleton_json.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/expect_error.h"
#include "tests/support/native_tang2018.h"

namespace choreo::retarget_test {

using testing_support::Native;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

// The direction of a bone in a pose.
Eigen::Vector3d Bone(const Skeleton& skeleton, const Pose& pose, const std::string& from,
                     const std::string& to) {
  const Eigen::Matrix3Xd places = JointPositions(skeleton, pose);
  return (places.col(skeleton.Find(to)) - places.col(skeleton.Find(from))).normalized();
}

TEST(Retarget, LimbsKeepTheirDirectionsAndFeetTheFloor) {
  Pose pose = RestPose(Smpl());
  pose.rotations.col(Smpl().Find("left_shoulder")) << 0, 0, 1.0;
  pose.rotations.col(Smpl().Find("right_elbow")) << 0, 1.2, 0;
  pose.rotations.col(Smpl().Find("right_hip")) << -0.9, 0, 0;
  pose.rotations.col(Smpl().Find("right_knee")) << 1.1, 0, 0;
  pose.rotations.col(0) << 0, 0.7, 0;
  const Skeleton& other = Native().skeleton;
  const Pose taken = Retarget(Smpl(), pose, other);
  ASSERT_EQ(taken.rotations.cols(), 23);
  for (const auto& [from, to] :
       {std::pair("left_shoulder", "left_elbow"), std::pair("right_elbow", "right_wrist"),
        std::pair("right_hip", "right_knee"), std::pair("right_knee", "right_ankle")}) {
    EXPECT_GT(Bone(Smpl(), pose, from, to).dot(Bone(other, taken, from, to)), 0.98)
        << from << " to " << to;
  }
  EXPECT_NEAR(taken.rotations(1, 0), 0.7, 0.1);
  // The dancer stands on the left foot, flat.
  const Eigen::Matrix3Xd places = JointPositions(other, taken);
  EXPECT_NEAR(places(1, other.feet[1]), 0.02, 0.01);
  EXPECT_NEAR(places(1, other.Find("left_heel")), 0.02, 0.01);
  EXPECT_GT(places(1, other.feet[3]), 0.1);
  pose.root_position.y() += 0.3;
  EXPECT_NEAR(JointPositions(other, Retarget(Smpl(), pose, other))(1, other.feet[1]), 0.32, 0.01);
}

TEST(Retarget, RoundTripKeepsTheDance) {
  const Motion motion = fixtures::SmoothMotion(Smpl(), 5, 40);
  const Skeleton& other = Native().skeleton;
  const Motion back = Retarget(other, Retarget(Smpl(), motion, other), Smpl());
  ASSERT_EQ(back.frames.size(), motion.frames.size());
  for (size_t frame = 0; frame < 40; frame += 5) {
    for (const auto& [from, to] :
         {std::pair("left_hip", "left_knee"), std::pair("right_shoulder", "right_elbow")}) {
      EXPECT_GT(Bone(Smpl(), motion.frames[frame], from, to)
                    .dot(Bone(Smpl(), back.frames[frame], from, to)),
                0.97)
          << frame;
    }
  }
}

TEST(Retarget, BetweenEqualBonesNothingChanges) {
  Skeleton rounded = Smpl();
  rounded.offsets = rounded.offsets.cast<float>().cast<double>().eval();
  const Motion motion = fixtures::SmoothMotion(Smpl(), 3, 5);
  const Motion same = Retarget(Smpl(), motion, rounded);
  for (size_t frame = 0; frame < 5; ++frame) {
    EXPECT_EQ(same.frames[frame].rotations, motion.frames[frame].rotations);
    EXPECT_EQ(same.frames[frame].root_position, motion.frames[frame].root_position);
  }
}

TEST(Retarget, ABodyWithoutKneesIsRefusedByName) {
  Skeleton stick = Native().skeleton;
  stick.left_knee = -1;
  ExpectError(ErrorCode::kInvalidArgument, "'tang2018' of 23 joints: none of them is the left_knee",
              [&] { Retarget(Smpl(), RestPose(Smpl()), stick); });
}

TEST(SkeletonJson, RoundTrips) {
  for (const Skeleton* skeleton : {&Smpl(), &Native().skeleton}) {
    EXPECT_EQ(SkeletonFromJson(SkeletonToJson(*skeleton)), *skeleton);
  }
  ExpectError(ErrorCode::kInvalidArgument, "skeleton: can't be read",
              [] { SkeletonFromJson("{}"); });
  Skeleton broken = Smpl();
  broken.right_knee = broken.left_knee;
  ExpectError(ErrorCode::kInvalidArgument,
              "skeleton.right_knee: 'left_knee' plays another role already",
              [&] { SkeletonFromJson(SkeletonToJson(broken)); });
}

}  // namespace choreo::retarget_test
