#include "model/fit/solver/fit_clip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/core/error.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/fit/fit_fixtures.h"
#include "tests/motion/motion_fixtures.h"

namespace choreo::fit_clip_test {

using fixtures::Positions;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

TEST(Fit, GivesTheSameBitsAgain) {
  const PositionClip clip = Positions(Smpl(), fixtures::SmoothMotion(Smpl(), 12, 30));
  const Motion a = FitClip(clip, IdentitySource(Smpl()), Smpl()).motion;
  const Motion b = FitClip(clip, IdentitySource(Smpl()), Smpl()).motion;
  for (size_t frame = 0; frame < a.frames.size(); ++frame) {
    EXPECT_EQ(a.frames[frame].rotations, b.frames[frame].rotations);
    EXPECT_EQ(a.frames[frame].root_position, b.frames[frame].root_position);
  }
}

TEST(Fit, StandsTheDancerOnTheFloor) {
  Motion motion = fixtures::SmoothMotion(Smpl(), 13, 5);
  motion.frames.assign(30, RestPose(Smpl()));
  for (Pose& pose : motion.frames) pose.root_position.y() += 0.4;
  const FitResult result = FitClip(Positions(Smpl(), motion), IdentitySource(Smpl()), Smpl());
  EXPECT_NEAR(result.ground_shift_m, -0.4, 0.002);
  EXPECT_NEAR(result.motion.frames[7].root_position.y(), Smpl().pelvis_height, 0.002);
}

TEST(Fit, GroundsDriftButNotJumps) {
  Motion motion;
  motion.frames.assign(600, RestPose(Smpl()));
  for (int frame = 0; frame < 600; ++frame) {
    const bool jumps = frame >= 300 && frame < 315;
    motion.frames[frame].root_position.y() += 0.2 + 0.01 * frame / 30.0 + (jumps ? 0.4 : 0.0);
  }
  const Motion grounded = FitClip(Positions(Smpl(), motion), IdentitySource(Smpl()), Smpl()).motion;
  for (int frame = 60; frame < 540; ++frame) {
    const bool jumps = frame >= 300 && frame < 315;
    EXPECT_NEAR(grounded.frames[frame].root_position.y(),
                Smpl().pelvis_height + (jumps ? 0.4 : 0.0), 0.02)
        << frame;
  }
}

// Some recordings sink a foot into the floor for half a second, which must not lift the body.
TEST(Ground, IgnoresASunkenFoot) {
  Motion motion;
  motion.frames.assign(300, RestPose(Smpl()));
  for (int frame = 150; frame < 168; ++frame) {
    motion.frames[frame].rotations(0, Smpl().feet[0]) = 0.7;  // toes point downwards
    motion.frames[frame].root_position.y() -= 0.05;
  }
  const Motion before = motion;
  EXPECT_NEAR(Ground(Smpl(), motion), 0, 0.002);
  for (int frame = 0; frame < 300; ++frame) {
    EXPECT_NEAR(motion.frames[frame].root_position.y(), before.frames[frame].root_position.y(),
                0.005)
        << frame;
  }
}

TEST(Fit, ReportsItsErrors) {
  const PositionClip clip = Positions(Smpl(), fixtures::SmoothMotion(Smpl(), 14, 20));
  const FitResult result = FitClip(clip, IdentitySource(Smpl()), Smpl());
  EXPECT_GT(result.mean_error_m, 0);
  EXPECT_LE(result.mean_error_m, result.p95_error_m);
  EXPECT_LT(result.p95_error_m, 0.02);
}

TEST(Fit, NamesWhatIsMissing) {
  PositionClip clip = Positions(Smpl(), fixtures::SmoothMotion(Smpl(), 15, 3));
  clip.joint_names[5] = "nobody";
  try {
    FitClip(clip, IdentitySource(Smpl()), Smpl());
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("right_knee"), std::string::npos);
  }
  clip.frames[1](0, 0) = std::nan("");
  EXPECT_THROW(FitClip(clip, IdentitySource(Smpl()), Smpl()), Error);
  EXPECT_THROW(FitClip(PositionClip{}, IdentitySource(Smpl()), Smpl()), Error);
  PositionFitter fitter(Smpl(), IdentitySource(Smpl()));
  EXPECT_THROW(fitter.Next(Eigen::Matrix3Xd::Zero(3, 23)), Error);
}

}  // namespace choreo::fit_clip_test
