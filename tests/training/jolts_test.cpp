#include "model/training/prepare/jolts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/motion/kinematics/kinematics.h"
#include "tests/support/synthetic_clips.h"

namespace choreo::jolts_test {

using testing::ElementsAre;
using testing::IsEmpty;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

Motion Calm(int frames = 90) {
  return testing_support::SyntheticClip("calm", frames, 0.3, false).motion;
}

double TopSpeed(const Motion& motion) {
  double top = 0;
  for (size_t f = 1; f < motion.frames.size(); ++f) {
    const Eigen::Matrix3Xd step =
        JointPositions(Smpl(), motion.frames[f]) - JointPositions(Smpl(), motion.frames[f - 1]);
    top = std::max(top, step.colwise().norm().maxCoeff() * motion.fps);
  }
  return top;
}

void Raise(Pose& pose, const char* joint, double angle) {
  pose.rotations(2, Smpl().Find(joint)) += angle;
}

TEST(JoltsTest, CalmMotionStaysAsItIs) {
  Motion motion = Calm();
  const Motion before = motion;
  EXPECT_THAT(FindBreaks(Smpl(), motion), IsEmpty());
  const LimbRepair repair = RepairLimbs(Smpl(), motion);
  EXPECT_EQ(repair.frames, 0);
  EXPECT_EQ(repair.left, 0);
  for (size_t f = 0; f < motion.frames.size(); ++f) {
    EXPECT_EQ(motion.frames[f].rotations, before.frames[f].rotations);
  }
}

TEST(JoltsTest, ASnappingLimbIsBridgedAndNothingElseChanges) {
  Motion motion = Calm();
  const Motion before = motion;
  Raise(motion.frames[40], "left_shoulder", 2.0);
  ASSERT_GT(TopSpeed(motion), 15);
  EXPECT_THAT(FindBreaks(Smpl(), motion), IsEmpty());
  const LimbRepair repair = RepairLimbs(Smpl(), motion);
  EXPECT_EQ(repair.frames, 7);  // the frame and 0.1 s to either side
  EXPECT_EQ(repair.left, 0);
  EXPECT_LT(TopSpeed(motion), 1.5 * TopSpeed(before));
  for (size_t f = 0; f < motion.frames.size(); ++f) {
    EXPECT_EQ(motion.frames[f].root_position, before.frames[f].root_position);
    for (int joint = 0; joint < Smpl().joints(); ++joint) {
      const std::string& name = Smpl().joint_names[joint];
      const bool arm = name == "left_collar" || name == "left_shoulder" || name == "left_elbow" ||
                       name == "left_wrist" || name == "left_hand";
      if (arm && f >= 37 && f <= 43) continue;
      EXPECT_EQ(motion.frames[f].rotations.col(joint), before.frames[f].rotations.col(joint))
          << name << " in frame " << f;
    }
  }
}

TEST(JoltsTest, SnapToANewPlaceIsBridgedToo) {
  Motion motion = Calm();
  for (int f = 50; f < 90; ++f) Raise(motion.frames[f], "right_hip", 0.9);
  ASSERT_GT(TopSpeed(motion), 12);
  EXPECT_EQ(RepairLimbs(Smpl(), motion).frames, 6);
  EXPECT_LT(TopSpeed(motion), 11);
}

TEST(JoltsTest, FastSwingIsNoJolt) {
  Motion motion = Calm();
  for (int f = 0; f < 90; ++f) {  // half a turn in a third of a second, faster and slower smoothly
    const double t = std::clamp((f - 40) / 10.0, 0.0, 1.0);
    Raise(motion.frames[f], "left_shoulder", 4.0 * t * t * (3 - 2 * t));
  }
  ASSERT_GT(TopSpeed(motion), 11);
  EXPECT_THAT(FindBreaks(Smpl(), motion), IsEmpty());
  EXPECT_EQ(RepairLimbs(Smpl(), motion).frames, 0);
}

TEST(JoltsTest, SnapOfTheWholeBodySplitsTheMotion) {
  Motion motion = Calm();
  for (int f = 60; f < 90; ++f) {
    Raise(motion.frames[f], "spine1", 1.5);
  }
  EXPECT_THAT(FindBreaks(Smpl(), motion), ElementsAre(60));
}

TEST(JoltsTest, ALimbThatSnapsNearAnEndIsCutOff) {
  Motion motion = Calm();
  Raise(motion.frames[0], "left_shoulder", 2.0);
  Raise(motion.frames[88], "left_shoulder", 2.0);
  EXPECT_THAT(FindBreaks(Smpl(), motion), ElementsAre(1, 88, 89));
}

TEST(JoltsTest, DenseJoltsAreCountedAndLeft) {
  Motion motion = Calm();
  for (int f = 30; f < 60; f += 4) Raise(motion.frames[f], "left_shoulder", 2.0);
  const LimbRepair repair = RepairLimbs(Smpl(), motion);
  EXPECT_EQ(repair.frames, 0);
  EXPECT_EQ(repair.left, 1);
}

}  // namespace choreo::jolts_test
