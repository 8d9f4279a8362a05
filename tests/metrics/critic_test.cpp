#include "model/metrics/critic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/core/numbers/random.h"
#include "tests/metrics/moving_body.h"

namespace choreo::critic_test {

using testing_support::Wave;

const Skeleton& Body() { return Skeleton::Smpl24(); }

// Dancers of one kind: limbs swing at rates and widths drawn for each clip, `wider` times as far.
CriticWindows Dancers(uint64_t seed, double wider) {
  CriticWindows windows;
  Random random(seed);
  for (size_t clip = 0; clip < 10; ++clip) {
    std::vector<Pose> poses(900, RestPose(Body()));
    for (int joint = 0; joint < Body().joints(); ++joint) {
      const double hz = random.Uniform(0.3, 2), width = random.Uniform(0.1, 0.6);
      for (size_t t = 0; t < poses.size(); ++t) {
        poses[t].rotations(0, joint) =
            wider * width * Wave(hz, static_cast<double>(t) / 30) + 0.005 * random.Normal();
      }
    }
    windows.Add(TrackJoints(Body(), poses), 30, clip);
  }
  return windows;
}

TEST(AreaUnderCurve, IsTheShareOfPairsInOrder) {
  EXPECT_EQ(AreaUnderCurve({3, 4}, {1, 2}), 1);
  EXPECT_EQ(AreaUnderCurve({1, 2}, {3, 4}), 0);
  EXPECT_EQ(AreaUnderCurve({1, 3}, {2}), 0.5);
  EXPECT_EQ(AreaUnderCurve({2}, {2}), 0.5);
  EXPECT_TRUE(std::isnan(AreaUnderCurve({}, {2})));
}

TEST(Critic, CutsAMotionIntoSeconds) {
  CriticWindows windows;
  windows.Add(JointTrack(100, JointPositions(Body(), RestPose(Body()))), 30, 7);
  EXPECT_EQ(windows.features.size(), 3U);
  EXPECT_EQ(windows.clips, (std::vector<size_t>{7, 7, 7}));
  EXPECT_TRUE(windows.features[0].allFinite());  // of one who stands still, too
}

TEST(Critic, SeparatesDifferentKindsAlone) {
  const CriticWindows real = Dancers(1, 1);
  EXPECT_NEAR(RealAgainstReal(real), 0.5, 0.05);
  EXPECT_GT(CriticArea(real, Dancers(2, 0.5)), 0.9);
  EXPECT_GT(CriticArea(real, Dancers(2, 0.5)), CriticArea(real, Dancers(2, 0.8)));
}

TEST(Critic, JudgesUnseenClipsAlone) {
  // The sides differ within each clip, not across clips.
  CriticWindows one = Dancers(3, 1), other = Dancers(4, 1);
  EXPECT_LT(CriticArea(one, other), 0.75);
  CriticWindows alone, beside;
  for (size_t i = 0; i < 30; ++i) {
    alone.features.push_back(one.features[i]);
    beside.features.push_back(other.features[i]);
    alone.clips.push_back(0), beside.clips.push_back(0);
  }
  EXPECT_TRUE(std::isnan(CriticArea(alone, beside)));
}

}  // namespace choreo::critic_test
