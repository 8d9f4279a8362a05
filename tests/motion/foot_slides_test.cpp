#include "model/motion/foot_slides.h"

#include <gtest/gtest.h>

#include <vector>

#include "model/motion/kinematics.h"

namespace choreo::foot_slides_test {

constexpr double kFps = 30;

const Skeleton& Body() { return Skeleton::Smpl24(); }
Eigen::Matrix3Xd Standing() { return JointPositions(Body(), RestPose(Body())); }

/// Moves the right foot's toes along z by `step` in each of `frames` steps.
std::vector<FootSlide> Slides(Eigen::Matrix3Xd joints, double step, int frames) {
  SlideWatch watch(Body(), kFps);
  for (int frame = 1; frame <= frames; ++frame) {
    Eigen::Matrix3Xd next = joints;
    next(2, Body().feet[3]) += step;
    watch.Add(frame, joints, next);
    joints = next;
  }
  EXPECT_TRUE(watch.Take().empty());  // still under way, if it is one
  watch.End();
  return watch.Take();
}

TEST(SlideWatch, NamesFootTimesAndWay) {
  const std::vector<FootSlide> slides = Slides(Standing(), 0.02, 10);
  ASSERT_EQ(slides.size(), 1U);
  EXPECT_EQ(slides[0].toes, Body().feet[3]);
  EXPECT_EQ(slides[0].first, 0);
  EXPECT_EQ(slides[0].last, 10);
  EXPECT_NEAR(slides[0].metres, 0.2, 1e-9);
}

TEST(SlideWatch, LeavesSteps) {
  Eigen::Matrix3Xd step = Standing();
  step(1, Body().feet[3]) += 1.1 * kSlideHeight;
  EXPECT_TRUE(Slides(step, 0.02, 10).empty());
  step(1, Body().feet[3]) -= 0.2 * kSlideHeight;
  EXPECT_EQ(Slides(step, 0.02, 10).size(), 1U);
  EXPECT_TRUE(Slides(Standing(), 0.9 * kSlideSpeed / kFps, 60).empty());
  EXPECT_TRUE(Slides(Standing(), 0.02, 4).empty());
}

TEST(SlideWatch, LeavesBodiesThatKneel) {
  Eigen::Matrix3Xd kneeling = Standing();
  kneeling(1, Body().left_knee) = 0.05;
  EXPECT_TRUE(Slides(kneeling, 0.02, 10).empty());
}

TEST(SlideWatch, AStopEndsASlide) {
  SlideWatch watch(Body(), kFps);
  const auto at = [](double z) -> Eigen::Matrix3Xd {
    return Standing().colwise() + Eigen::Vector3d(0, 0, z);
  };
  for (int frame = 1; frame <= 6; ++frame)
    watch.Add(frame, at(0.02 * (frame - 1)), at(0.02 * frame));
  watch.Add(7, at(0.12), at(0.12));
  const std::vector<FootSlide> slides = watch.Take();
  ASSERT_EQ(slides.size(), 2U);  // one of each foot
  EXPECT_EQ(slides[0].last, 6);
  EXPECT_TRUE(watch.Take().empty());
}

}  // namespace choreo::foot_slides_test
