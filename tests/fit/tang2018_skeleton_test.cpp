#include "model/fit/sources/tang2018_skeleton.h"

#include <gtest/gtest.h>

#include "model/fit/solver/fit_clip.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/rotation.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/expect_error.h"
#include "tests/support/native_tang2018.h"

namespace choreo::tang2018_skeleton_test {

using testing_support::Native;
using testing_support::RecordNative;

TEST(Tang2018Skeleton, HasTheBonesOfTheRecordingsStandingUpright) {
  const Skeleton& skeleton = Native().skeleton;
  const Skeleton& dancer = Skeleton::Smpl24();
  EXPECT_EQ(skeleton.joints(), 23);
  EXPECT_EQ(skeleton.joint_names.front(), "waist");
  skeleton.RequireRoles();
  const auto bone = [](const Skeleton& of, const char* joint) {
    return of.offsets.col(of.Find(joint)).norm();
  };
  for (const char* joint : {"knee", "elbow"}) {
    const std::string left = std::string("left_") + joint, right = std::string("right_") + joint;
    const double mean = 0.5 * (bone(dancer, left.c_str()) + bone(dancer, right.c_str()));
    EXPECT_NEAR(bone(skeleton, left.c_str()), mean, 1e-6) << joint;
    EXPECT_NEAR(bone(skeleton, right.c_str()), mean, 1e-6) << joint;
  }
  const Eigen::Matrix3Xd rest = JointPositions(skeleton, RestPose(skeleton));
  const auto at = [&](const char* joint) -> Eigen::Vector3d {
    return rest.col(skeleton.Find(joint));
  };
  EXPECT_NEAR(at("left_toes").y(), 0.02, 1e-9);
  EXPECT_NEAR(at("left_heel").y(), 0.02, 1e-9);
  EXPECT_GT(at("left_toes").z() - at("left_heel").z(), 0.15);
  EXPECT_GT(at("head").y(), at("left_shoulder").y() + 0.05);
  EXPECT_GT(at("left_hand").x(), 0.5);
  EXPECT_LT(at("right_hand").x(), -0.5);
  // Its sides are mirror images except below the elbows.
  const std::vector<int> pairs = MirrorPairs(skeleton);
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const std::string& name = skeleton.joint_names[static_cast<size_t>(joint)];
    if (name.ends_with("wrist") || name.ends_with("hand") || name.ends_with("thumb")) continue;
    const Eigen::Vector3d other = rest.col(pairs[static_cast<size_t>(joint)]);
    EXPECT_LT((rest.col(joint) - Eigen::Vector3d(-other.x(), other.y(), other.z())).norm(), 1e-9)
        << name;
  }
}

TEST(Tang2018Skeleton, RecoversADanceFromRecordedPositions) {
  const auto& [skeleton, mapping] = Native();
  const Motion motion = fixtures::SmoothMotion(skeleton, 31, 60);
  const FitResult fit = FitClip(RecordNative(motion), mapping, skeleton, {.ground = false});
  EXPECT_LT(fit.mean_error_m, 0.015);
  double sum = 0;
  for (size_t frame = 0; frame < motion.frames.size(); ++frame) {
    sum += (JointPositions(skeleton, fit.motion.frames[frame]) -
            JointPositions(skeleton, motion.frames[frame]))
               .colwise()
               .norm()
               .mean();
  }
  EXPECT_LT(sum / static_cast<double>(motion.frames.size()), 0.02);
}

TEST(Tang2018Skeleton, HipsTurnAgainstTheChest) {
  const auto& [skeleton, mapping] = Native();
  Motion motion{.fps = 30, .frames = {}};
  for (int frame = 0; frame < 60; ++frame) {
    Pose pose = RestPose(skeleton);
    const double turn = 0.4 * std::sin(frame * 0.1);
    pose.rotations.col(0).y() = turn;
    pose.rotations.col(skeleton.Find("chest")).y() = -turn;
    motion.frames.push_back(pose);
  }
  const FitResult fit = FitClip(RecordNative(motion), mapping, skeleton);
  for (size_t frame = 0; frame < 60; frame += 7) {
    const Pose& found = fit.motion.frames[frame];
    EXPECT_NEAR(found.rotations(1, 0), motion.frames[frame].rotations(1, 0), 0.12);
    EXPECT_NEAR(found.rotations(1, skeleton.Find("chest")), -motion.frames[frame].rotations(1, 0),
                0.12);
  }
}

TEST(Tang2018Skeleton, RefusesOtherRecordings) {
  ExpectError(ErrorCode::kInvalidArgument, "0 recordings", [] { MeasureTang2018({}); });
  PositionClip clip = RecordNative({.fps = 25, .frames = {RestPose(Native().skeleton)}});
  for (Eigen::Matrix3Xd& frame : clip.frames) frame *= 100;  // centimetres
  ExpectError(ErrorCode::kInvalidArgument, "no length of a body",
              [&] { MeasureTang2018(std::span(&clip, 1)); });
  clip.joint_names.front() = "nose";
  ExpectError(ErrorCode::kInvalidArgument, "not those of tang2018",
              [&] { MeasureTang2018(std::span(&clip, 1)); });
}

}  // namespace choreo::tang2018_skeleton_test
