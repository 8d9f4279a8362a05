#include "model/plan/contact_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/motion/pose/body_limits.h"
#include "model/plan/toes_path.h"

namespace choreo::contact_plan_test {

constexpr double kFps = 30;
constexpr int kFrames = 60;

// Feet that stand `apart` from the middle, on the floor, below the body.
FootTrack Standing(double x) {
  FootTrack foot;
  foot.before = {x, 0.02, 0};
  foot.stood = true;
  foot.toes.assign(kFrames, foot.before);
  foot.heights.assign(kFrames, 0);
  foot.unbalanced.assign(kFrames, 0);
  return foot;
}

void Lift(FootTrack* foot, int from, int to, double height) {
  for (int i = from; i < to; ++i) {
    foot->heights[static_cast<size_t>(i)] = height;
    foot->toes[static_cast<size_t>(i)].y() += height;
  }
}

int FramesInAir(const std::array<std::vector<Stance>, 2>& stances) {
  int count = 0;
  for (int i = 0; i < kFrames; ++i)
    count += StanceAt(stances[0], i) == nullptr && StanceAt(stances[1], i) == nullptr;
  return count;
}

TEST(PlanContacts, StandingFeetStayInContact) {
  for (const auto& stances : PlanContacts({Standing(0.1), Standing(-0.1)}, kFps, {})) {
    ASSERT_EQ(stances.size(), 1U);
    EXPECT_EQ(stances[0].from, 0);
    EXPECT_EQ(stances[0].to, kFrames - 1);
  }
}

TEST(PlanContacts, LiftedFootIsInTheAirAndTheOtherSupports) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  Lift(&feet[0], 20, 35, 0.3);
  const auto stances = PlanContacts(feet, kFps, {});
  ASSERT_EQ(stances[0].size(), 2U);
  EXPECT_NEAR(stances[0][0].to, 19, 1);
  EXPECT_NEAR(stances[0][1].from, 35, 1);
  EXPECT_EQ(stances[1].size(), 1U);
}

TEST(PlanContacts, AGlidingFootSteps) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  for (FootTrack& foot : feet) {
    for (size_t i = 0; i < kFrames; ++i) foot.toes[i].z() = 0.02 * static_cast<double>(i + 1);
  }
  const auto stances = PlanContacts(feet, kFps, {});
  EXPECT_GE(stances[0].size() + stances[1].size(), 4U);
  EXPECT_EQ(FramesInAir(stances), 0);
  for (const auto& foot : stances) {
    for (const Stance& stance : foot) {
      const double middle = 0.01 * (stance.from + stance.to + 2);
      if (stance.from == 0) continue;
      EXPECT_NEAR(stance.place.z(), middle, 1e-9);
    }
  }
}

TEST(PlanContacts, HoveringBodyGetsContacts) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  for (FootTrack& foot : feet) Lift(&foot, 0, kFrames, 0.12);
  EXPECT_EQ(FramesInAir(PlanContacts(feet, kFps, {})), 0);
}

TEST(PlanContacts, NoFlightLastsLongerThanTheLongest) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  for (FootTrack& foot : feet) Lift(&foot, 20, 28, 0.8);
  EXPECT_GT(FramesInAir(PlanContacts(feet, kFps, {})), 4);
  for (FootTrack& foot : feet) Lift(&foot, 28, 50, 0.8);
  const FootworkOptions options;
  EXPECT_LE(FramesInAir(PlanContacts(feet, kFps, options)), options.longest_flight * kFps);
}

TEST(PlanContacts, KeyDecidesItsContacts) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  feet[0].end = FootTrack::End::kInAir;
  Lift(&feet[0], kFrames - 1, kFrames, 0.4);
  feet[0].fall_after = 0.4;
  feet[1].end = FootTrack::End::kStands;
  feet[1].toes.back() = {-0.3, 0.05, 0.4};
  const auto stances = PlanContacts(feet, kFps, {});
  EXPECT_EQ(StanceAt(stances[0], kFrames - 1), nullptr);
  const Stance* last = StanceAt(stances[1], kFrames - 1);
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(last->place, feet[1].toes.back());
  // A foot in the air needs the time of a fall.
  EXPECT_EQ(StanceAt(stances[0], kFrames - 5), nullptr);
}

TEST(PlanContacts, AFootInTheAirLandsNoSoonerThanItFalls) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  feet[0].stood = false;
  feet[0].fall_before = 0.3;
  const auto stances = PlanContacts(feet, kFps, {});
  ASSERT_EQ(stances[0].size(), 1U);
  EXPECT_EQ(stances[0][0].from, 8);  // sqrt(2 0.3 / 9.81) s
}

// A body low over the floor has hardly any fall left, even with its feet at the height of its head:
// a foot once came down from there within two frames, at 20 m/s.
TEST(PlanContacts, AFootHighUpComesDownNoFasterThanLegsMove) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  for (FootTrack& foot : feet) {
    Lift(&foot, 0, 30, 0.9);
    foot.before.y() += 0.9;
    foot.height_before = 0.9;
    foot.stood = false;
  }
  const auto stances = PlanContacts(feet, kFps, {});
  for (size_t side = 0; side < 2; ++side) {
    const auto path = ToesPath(feet[side], stances[side], 0.02, false, kFps, 0.15);
    Eigen::Vector3d before = feet[side].before;
    for (size_t i = 0; i < path.size(); ++i) {
      EXPECT_LE((path[i] - before).norm() * kFps, kFastestJoint) << "foot " << side << " at " << i;
      before = path[i];
    }
  }
}

// Falling takes longer than flights may last, so no plan has all it should; a key on the floor once
// lost all stances then, and the body floated to it.
TEST(PlanContacts, AFallFromHighUpEndsLongBeforeTheKey) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  for (FootTrack& foot : feet) {
    Lift(&foot, 0, kFrames - 1, 0.5);
    foot.stood = false;
    foot.fall_before = 1.2;  // 15 frames of falling
    foot.end = FootTrack::End::kStands;
  }
  EXPECT_LE(FramesInAir(PlanContacts(feet, kFps, {})), 15);
}

// A pose on one leg that is held has keys nearer to each other than the time of a fall.
TEST(PlanContacts, AFootThatStaysUpDoesNotFall) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  for (FootTrack& foot : feet) {
    foot.toes.resize(6);
    foot.heights.resize(6);
    foot.unbalanced.resize(6);
    foot.end = FootTrack::End::kStands;
  }
  Lift(&feet[0], 0, 6, 1);
  feet[0].stood = false;
  feet[0].fall_before = 1;
  feet[0].end = FootTrack::End::kInAir;
  const auto stances = PlanContacts(feet, kFps, {});
  EXPECT_TRUE(stances[0].empty());
  ASSERT_EQ(stances[1].size(), 1U);
  EXPECT_EQ(stances[1][0].to, 5);
}

// A leg can kick faster than it would fall; once it stood until the key, and was up a frame later.
TEST(PlanContacts, AKickLeavesTheFloorAtOnceIfTimeIsShort) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  for (FootTrack& foot : feet) {
    foot.toes.resize(15);
    foot.heights.resize(15);
    foot.unbalanced.resize(15);
    foot.end = FootTrack::End::kStands;
  }
  Lift(&feet[0], 5, 15, 1.3);
  feet[0].fall_after = 1.3;  // 16 frames of falling
  feet[0].end = FootTrack::End::kInAir;
  EXPECT_TRUE(PlanContacts(feet, kFps, {})[0].empty());
}

TEST(PlanContacts, DoesNotDependOnTheScenesPlace) {
  std::array<FootTrack, 2> feet = {Standing(0.1), Standing(-0.1)};
  for (size_t i = 0; i < kFrames; ++i) feet[0].toes[i].z() += 0.015 * static_cast<double>(i);
  Lift(&feet[1], 10, 20, 0.2);
  const auto here = PlanContacts(feet, kFps, {});
  const Eigen::Vector3d by(3, 0, -5);
  for (FootTrack& foot : feet) {
    foot.before += by;
    for (Eigen::Vector3d& toes : foot.toes) toes += by;
  }
  const auto there = PlanContacts(feet, kFps, {});
  for (size_t side = 0; side < 2; ++side) {
    ASSERT_EQ(here[side].size(), there[side].size());
    for (size_t i = 0; i < here[side].size(); ++i) {
      EXPECT_EQ(here[side][i].from, there[side][i].from);
      Eigen::Vector3d moved = there[side][i].place - here[side][i].place;
      moved.y() = 0;
      EXPECT_NEAR((moved - by).norm(), 0, 1e-9);
    }
  }
}

// The next plan goes on with the step.
TEST(ToesPath, AFootThatLeavesAtAnOpenEndOnlyBeginsItsStep) {
  FootTrack foot = Standing(0.1);
  Lift(&foot, kFrames - 1, kFrames, 0.2);
  foot.toes.back().z() += 0.3;
  const std::vector<Stance> stances = {{0, kFrames - 2, foot.before}};
  const auto moved = [&](bool keyed) {
    const auto toes = ToesPath(foot, stances, 0.02, keyed, kFps, FootworkOptions{}.shortest_step);
    return (toes[kFrames - 1] - toes[kFrames - 2]).norm();
  };
  EXPECT_GT(moved(true), 0.3) << "a key is reached in any case";
  EXPECT_LT(moved(false), 0.1);
}

}  // namespace choreo::contact_plan_test
