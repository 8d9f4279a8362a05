#include "model/plan/footwork.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/core/numbers/random.h"
#include "model/core/numbers/smooth_step.h"
#include "model/motion/kinematics/body_mass.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/limb.h"
#include "model/motion/pose/body_limits.h"
#include "model/motion/rotation.h"

namespace choreo::footwork_test {

constexpr double kFps = 30;
constexpr int kFrames = 60;

const Skeleton& Body() { return Skeleton::Smpl24(); }

// Standing with soft knees, moved by `by`.
Pose At(const Eigen::Vector3d& by) {
  Pose pose = RestPose(Body());
  for (const Leg& leg : Leg::Of(Body())) {
    pose.rotations.col(leg.hip).x() = -0.25;
    pose.rotations.col(leg.knee).x() = 0.5;
    pose.rotations.col(leg.ankle).x() = -0.25;
  }
  pose.root_position.y() = *StandingHeight(Body(), pose);
  pose.root_position += by;
  return pose;
}

const std::vector<Pose> kHistory(10, At({0, 0, 0}));

FootworkContext Context() { return {.skeleton = Body(), .history = kHistory, .fps = kFps}; }

std::vector<Pose> Glide(double metres_a_frame, double height = 0) {
  std::vector<Pose> plan;
  for (int i = 1; i <= kFrames; ++i)
    plan.push_back(At({0, height * std::min(1.0, i / 10.0), metres_a_frame * i}));
  return plan;
}

double LowestFoot(const Pose& pose) {
  const Eigen::Matrix3Xd at = JointPositions(Body(), pose);
  double lowest = INFINITY;
  for (const int foot : {Body().feet[1], Body().feet[3]}) lowest = std::min(lowest, at(1, foot));
  return lowest;
}

TEST(StandOnFeet, LeavesAStandingBody) {
  std::vector<Pose> plan(kFrames, At({0, 0, 0}));
  const Footwork footwork = StandOnFeet(Context(), &plan);
  ASSERT_EQ(footwork.contacts.size(), plan.size());
  for (size_t i = 0; i < plan.size(); ++i) {
    EXPECT_LT(ComparePoses(Body(), plan[i], At({0, 0, 0})).position_m, 0.01) << i;
    EXPECT_EQ(footwork.contacts[i], (Contacts{1, 1, 1, 1}));
  }
}

// A step brings toes to a key's place in the key's frame. As they still moved, they did not count
// as standing, and left along the floor at 6 m/s.
TEST(StandOnFeet, FeetThatHaveJustLandedStand) {
  const auto first_contacts = [](double earlier, double later) {
    std::vector<Pose> history(8, At({0, 0, 0}));
    history.push_back(At({0, 0, earlier}));
    history.push_back(At({0, 0, earlier + later}));
    FootworkContext context = Context();
    context.history = history;
    std::vector<Pose> plan(kFrames, At({0, 0, earlier + later}));
    return StandOnFeet(context, &plan).contacts.front();
  };
  EXPECT_EQ(first_contacts(0.1, 0.02), (Contacts{1, 1, 1, 1}));
  EXPECT_EQ(first_contacts(0.1, 0.1), (Contacts{0, 0, 0, 0}));  // slide on
}

// Keys of one pose a fifth of a second apart: feet that settled on the floor between them, and a
// pelvis that balanced, went there and back five times a second.
TEST(StandOnFeet, LeavesAHeldPose) {
  for (const double pointed : {0.0, 1.0}) {  // on the toes
    Pose held = At({0, 0, 0});
    held.rotations.col(0).x() = 0.3;  // leans
    for (const Leg& leg : Leg::Of(Body())) held.rotations.col(leg.ankle).x() += pointed;
    held.root_position.y() = *StandingHeight(Body(), held) + 0.01;
    const std::vector<Pose> history(10, held);
    std::vector<Pose> plan(6, held);
    FootworkContext context = Context();
    context.history = history;
    context.keyed = context.held = true;
    StandOnFeet(context, &plan);
    for (const Pose& pose : plan) {
      EXPECT_EQ(pose.root_position, held.root_position);
      EXPECT_LT(ComparePoses(Body(), pose, held).position_m, 0.002) << pointed;
    }
  }
}

// The foot behind a kneeling body stands steeply; when a hold ended it lay down in one frame.
TEST(StandOnFeet, ASteepFootLiesDownSlowly) {
  Pose steep = At({0, 0, 0});
  for (const Leg& leg : Leg::Of(Body())) steep.rotations.col(leg.ankle).x() += 1.2;
  steep.root_position.y() = *StandingHeight(Body(), steep);
  const std::vector<Pose> history(10, steep);
  std::vector<Pose> plan(kFrames, steep);
  FootworkContext context = Context();
  context.history = history;
  StandOnFeet(context, &plan);
  const double whole = ComparePoses(Body(), plan.back(), steep).angle_deg;
  EXPECT_GT(whole, 20);
  Pose before = steep;
  for (const Pose& pose : plan) {
    EXPECT_LT(ComparePoses(Body(), pose, before).angle_deg, whole * 2 / 3);
    before = pose;
  }
}

// Half toes were in front of an upright foot, and behind it a frame later: the ankle turned by 80
// degrees at once.
TEST(StandOnFeet, AFootThatTipsOverItsToesDoesNotSnap) {
  // The feet point forwards, this far down.
  const auto tipped = [](double down) {
    Pose pose = At({0, 0, 0});
    const JointPlacement at = ForwardKinematics(Body(), pose);
    for (const Leg& leg : Leg::Of(Body())) {
      const Eigen::Vector3d foot = at.positions.col(leg.toes) - at.positions.col(leg.ankle);
      const Eigen::Matrix3d turned =
          Eigen::Quaterniond::FromTwoVectors(foot,
                                             Eigen::Vector3d(0, -std::sin(down), std::cos(down))) *
          at.rotations[static_cast<size_t>(leg.ankle)];
      pose.rotations.col(leg.ankle) =
          LogMap(at.rotations[static_cast<size_t>(leg.knee)].transpose() * turned);
    }
    pose.root_position.y() = *StandingHeight(Body(), pose);
    const int toes = Body().feet[1];  // in their place
    pose.root_position.z() -= JointPositions(Body(), pose)(2, toes);
    return pose;
  };
  const std::vector<Pose> history(10, tipped(0.8));
  std::vector<Pose> plan;
  for (int i = 1; i <= kFrames; ++i) plan.push_back(tipped(0.8 + 1.6 * std::min(1.0, i / 20.0)));
  FootworkContext context = Context();
  context.history = history;
  StandOnFeet(context, &plan);
  Pose before = history.back();
  double most = 0;
  for (const Pose& pose : plan) {
    for (const Leg& leg : Leg::Of(Body()))
      most = std::max(
          most, RotationDifference(before.rotations.col(leg.ankle), pose.rotations.col(leg.ankle))
                    .norm());
    before = pose;
  }
  EXPECT_LT(most * kDegrees, 24);
}

// With its feet at its chest, a body lands when it has fallen, not when the feet have.
TEST(StandOnFeet, ATuckedBodyLandsInTimeForItsOwnFall) {
  const auto falling = [](double share) {  // of its way to where it stands
    Pose pose = At({0, 0.3 * (1 - share * share), 0});
    for (const Leg& leg : Leg::Of(Body())) {
      pose.rotations.col(leg.hip).x() -= 1.7 * (1 - share);
      pose.rotations.col(leg.knee).x() += 1.7 * (1 - share);
    }
    return pose;
  };
  ASSERT_GT(LowestFoot(falling(0)), 0.6);  // whose fall alone would take 11 frames
  const std::vector<Pose> history(10, falling(0));
  std::vector<Pose> plan;
  for (int i = 1; i <= kFrames; ++i) plan.push_back(falling(std::min(1.0, i / 8.0)));
  FootworkContext context = Context();
  context.history = history;
  const Footwork footwork = StandOnFeet(context, &plan);
  int air = 0;
  while (footwork.contacts[static_cast<size_t>(air)] == Contacts{0, 0, 0, 0}) ++air;
  EXPECT_LE(air, 8);
  EXPECT_GE(air, 6);
}

// Knees went through the floor on the way to splits and from them.
TEST(StandOnFeet, NoKneeGoesThroughTheFloor) {
  std::vector<Pose> plan;
  for (int i = 1; i <= kFrames; ++i) {
    const double low = std::pow(std::sin(M_PI * i / kFrames), 2);
    Pose pose = At({0, -0.65 * low, 0});
    for (const Leg& leg : Leg::Of(Body())) {
      pose.rotations.col(leg.hip).x() += 0.25 * low;  // upright on the knees
      pose.rotations.col(leg.knee).x() += 1.1 * low;
    }
    plan.push_back(pose);
  }
  const auto lowest = [](const Pose& pose) {
    return JointPositions(Body(), pose).row(1).minCoeff();
  };
  ASSERT_LT(lowest(plan[kFrames / 2]), -0.1);
  StandOnFeet(Context(), &plan);
  double before = plan.front().root_position.y();
  for (const Pose& pose : plan) {
    EXPECT_GT(lowest(pose), -0.02);
    EXPECT_LT(std::abs(pose.root_position.y() - before), 0.06);
    before = pose.root_position.y();
  }
}

// Sits on the floor, each leg stretched out and raised by so many radians.
Pose Sitting(double left, double right) {
  Pose pose = RestPose(Body());
  const auto legs = Leg::Of(Body());
  pose.rotations.col(legs[0].hip).x() = -M_PI / 2 - left;
  pose.rotations.col(legs[1].hip).x() = -M_PI / 2 - right;
  pose.root_position.y() = 0.2;
  return pose;
}

// A leg that swings from front to back, as on the way to splits, went through the floor, and its
// knee flew off at 20 m/s.
TEST(StandOnFeet, ASittingBodyRisesToSwingALeg) {
  constexpr int kSwing = 45;  // frames
  const std::vector<Pose> history(10, Sitting(0, 0));
  std::vector<Pose> plan;
  for (int i = 1; i <= kSwing; ++i) plan.push_back(Sitting(-M_PI * i / kSwing, 0));
  const auto lowest = [](const Pose& pose) {
    return JointPositions(Body(), pose).row(1).minCoeff();
  };
  ASSERT_LT(lowest(plan[kSwing / 2]), -0.5);
  FootworkContext context = Context();
  context.history = history;
  context.keyed = true;
  StandOnFeet(context, &plan);
  for (const Pose& pose : plan) EXPECT_GT(lowest(pose), -0.1);
  EXPECT_LT(FindFastestStep(Body(), history.back(), plan, kFps).m_per_s, kFastestJoint);
}

// Once she is high enough, she hardly sinks again, as the plan catches up: by 7 cm here (4 before
// raises began with the plan, which halved turns of height in dances), once by 36 cm in a dance.
TEST(StandOnFeet, ARisingBodyIsLiftedNoHigherThanItMust) {
  constexpr int kRise = 45, kSwing = 20;  // frames
  const std::vector<Pose> history(10, Sitting(0, 0));
  std::vector<Pose> plan;
  for (int i = 1; i <= kRise; ++i) {
    plan.push_back(Sitting(-M_PI * std::min(1.0, 1.0 * i / kSwing), 0));
    plan.back().root_position.y() += 0.8 * i / kRise;
  }
  FootworkContext context = Context();
  context.history = history;
  context.keyed = true;
  const auto lowest = [](const Pose& pose) {
    return JointPositions(Body(), pose).row(1).minCoeff();
  };
  ASSERT_LT(lowest(plan[kSwing / 2]), -0.2);
  StandOnFeet(context, &plan);
  for (const Pose& pose : plan) EXPECT_GT(lowest(pose), -0.1);
  double highest = 0, falls = 0;
  for (const Pose& pose : plan) {
    highest = std::max(highest, pose.root_position.y());
    falls = std::max(falls, highest - pose.root_position.y());
  }
  EXPECT_LT(falls, 0.08);
}

// The seat was not known to touch the floor, so the way down to it was a leap.
TEST(StandOnFeet, ABodyThatSitsDownDoesNotLeap) {
  constexpr int kDown = 30;  // frames
  std::vector<Pose> plan;
  for (int i = 1; i <= kDown; ++i) {
    const double share = SmoothStep(1.0 * i / kDown);
    Pose pose = Sitting(0, 0);
    for (const Leg& leg : Leg::Of(Body())) pose.rotations.col(leg.hip).x() *= share;
    pose.root_position.y() +=
        (1 - share) * (kHistory[0].root_position.y() - pose.root_position.y());
    plan.push_back(pose);
  }
  FootworkContext context = Context();
  context.keyed = true;
  StandOnFeet(context, &plan);
  double rises = 0, before = kHistory[0].root_position.y();
  for (const Pose& pose : plan) {
    rises = std::max(rises, pose.root_position.y() - before);
    before = pose.root_position.y();
  }
  EXPECT_LT(rises, 0.01);
}

// Both feet came down to the floor, as if they had to carry the body.
TEST(StandOnFeet, ASittingBodyMayRaiseItsFeet) {
  const std::vector<Pose> history(10, Sitting(0.5, 0.5));
  std::vector<Pose> plan(kFrames, history.back());
  const double raised = LowestFoot(plan.front());
  ASSERT_GT(raised, 0.3);
  FootworkContext context = Context();
  context.history = history;
  const Footwork footwork = StandOnFeet(context, &plan);
  for (size_t i = 0; i < plan.size(); ++i) {
    EXPECT_NEAR(LowestFoot(plan[i]), raised, 0.05);
    EXPECT_EQ(footwork.contacts[i], (Contacts{0, 0, 0, 0}));
  }
}

TEST(StandOnFeet, FeetOfAGlidingBodyStandAndStep) {
  std::vector<Pose> plan = Glide(0.015);
  const Footwork footwork = StandOnFeet(Context(), &plan);
  int steps = 0;
  for (size_t i = 1; i < plan.size(); ++i) {
    const Eigen::Matrix3Xd before = JointPositions(Body(), plan[i - 1]);
    const Eigen::Matrix3Xd now = JointPositions(Body(), plan[i]);
    for (const size_t toes : {1U, 3U}) {
      const bool stood = footwork.contacts[i - 1][toes] > 0,
                 stands = footwork.contacts[i][toes] > 0;
      steps += !stood && stands;
      const int joint = Body().feet[toes];
      if (!stood || !stands) continue;
      EXPECT_LT((now.col(joint) - before.col(joint)).norm(), 0.006) << i;
    }
    EXPECT_TRUE(footwork.contacts[i][1] > 0 || footwork.contacts[i][3] > 0);
  }
  EXPECT_GE(steps, 3);
}

TEST(StandOnFeet, LowersAHoveringBody) {
  std::vector<Pose> plan = Glide(0.005, 0.12);
  ASSERT_GT(LowestFoot(plan[kFrames / 2]), 0.1);
  StandOnFeet(Context(), &plan);
  for (const Pose& pose : plan) EXPECT_LT(LowestFoot(pose), 0.05);
}

TEST(StandOnFeet, HeelsStayAboveTheFloor) {
  std::vector<Pose> plan = Glide(0.005);
  for (Pose& pose : plan) {
    for (const Leg& leg : Leg::Of(Body())) pose.rotations.col(leg.ankle).x() -= 0.6;
  }
  StandOnFeet(Context(), &plan);
  const Eigen::Matrix3Xd rest = JointPositions(Body(), RestPose(Body()));
  for (size_t i = 10; i < plan.size(); ++i) {
    const Eigen::Matrix3Xd at = JointPositions(Body(), plan[i]);
    for (const size_t ankle : {0U, 2U})
      EXPECT_GT(at(1, Body().feet[ankle]), rest(1, Body().feet[ankle]) - 0.01) << i;
  }
}

TEST(StandOnFeet, NothingTouchesAKey) {
  std::vector<Pose> plan = Glide(0.01, 0.1);
  const Pose key = plan.back();
  FootworkContext context = Context();
  context.keyed = true;
  StandOnFeet(context, &plan);
  EXPECT_EQ(plan.back().root_position, key.root_position);
  EXPECT_EQ(plan.back().rotations, key.rotations);
}

TEST(StandOnFeet, FeetReachTheKeysFootprints) {
  std::vector<Pose> plan = Glide(0.01);
  FootworkContext context = Context();
  context.keyed = true;
  StandOnFeet(context, &plan);
  const Eigen::Matrix3Xd before = JointPositions(Body(), plan[kFrames - 2]);
  const Eigen::Matrix3Xd key = JointPositions(Body(), plan.back());
  for (const size_t toes : {1U, 3U}) {
    const Eigen::Vector3d step = (key - before).col(Body().feet[toes]);
    EXPECT_LT(std::hypot(step.x(), step.z()), 0.02);  // along the floor; one may just come down
  }
}

TEST(StandOnFeet, APathKeepsItsPlaceOnTheFloor) {
  std::vector<Pose> plan = Glide(0.01, 0.1);
  const std::vector<Pose> proposed = plan;
  FootworkContext context = Context();
  context.has_path = true;
  StandOnFeet(context, &plan);
  for (size_t i = 0; i < plan.size(); ++i) {
    EXPECT_EQ(plan[i].root_position.x(), proposed[i].root_position.x());
    EXPECT_EQ(plan[i].root_position.z(), proposed[i].root_position.z());
  }
}

// Bowing, the body is far ahead of its feet, and a path does not let it back.
TEST(StandOnFeet, OnAPathFeetStepUnderTheBody) {
  std::vector<Pose> plan = Glide(0.01);
  for (Pose& pose : plan) {
    for (const char* joint : {"spine1", "spine2", "spine3"})
      pose.rotations.col(Body().Find(joint)).x() = 0.5;
  }
  FootworkContext context = Context();
  context.has_path = true;
  const Footwork footwork = StandOnFeet(context, &plan);
  const Eigen::VectorXd masses = MassWeights(Body());
  double beyond = 0;
  for (size_t i = 20; i < 50; ++i) {
    const Eigen::Matrix3Xd at = JointPositions(Body(), plan[i]);
    double ahead = -INFINITY;
    for (const size_t toes : {1, 3}) {
      if (footwork.contacts[i][toes] > 0) ahead = std::max(ahead, at(2, Body().feet[toes]));
    }
    beyond += std::max(0.0, (at * masses).z() - ahead) / 30;
  }
  EXPECT_LT(beyond, 0.1);
}

TEST(StandOnFeet, TurningTheSceneTurnsTheDance) {
  const GroundFrame ground{{2, 0, -1}, 0.7};
  const auto all = [&](std::vector<Pose> poses) {
    for (Pose& pose : poses) pose = ground.ToWorld(pose);
    return poses;
  };
  std::vector<Pose> here = Glide(0.012, 0.06);
  std::vector<Pose> there = all(here);
  StandOnFeet(Context(), &here);
  const std::vector<Pose> history = all(kHistory);
  FootworkContext context = Context();
  context.history = history;
  StandOnFeet(context, &there);
  here = all(here);
  for (size_t i = 0; i < here.size(); ++i)
    EXPECT_LT(ComparePoses(Body(), here[i], there[i]).position_m, 1e-6) << i;
}

TEST(StandOnFeet, LongPlansAreContinuousAcrossPieces) {
  std::vector<Pose> plan = Glide(0.012, 0.08);
  std::vector<Pose> first(plan.begin(), plan.begin() + 30), rest(plan.begin() + 30, plan.end());
  FootworkContext context = Context();
  context.offset_before = StandOnFeet(context, &first).offset;
  context.history = std::span(first).last(10);
  StandOnFeet(context, &rest);
  const double before = (first[29].root_position - first[28].root_position).norm();
  EXPECT_NEAR((rest[0].root_position - first[29].root_position).norm(), before, 0.01);
}

TEST(StandOnFeet, LeavesASkeletonWithoutLegs) {
  Skeleton legless = Body();
  legless.feet = {-1, -1, -1, -1};
  FootworkContext context{.skeleton = legless, .history = kHistory, .fps = kFps};
  std::vector<Pose> plan = Glide(0.01);
  EXPECT_TRUE(StandOnFeet(context, &plan).contacts.empty());
  EXPECT_EQ(plan.back().root_position, Glide(0.01).back().root_position);
}

// Bodies below the floor, tumbling or thrown about are no dancers, but must not fail.
TEST(StandOnFeet, ExtremePlansStayFinite) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const double height = random.Uniform(-3, 3), way = random.Uniform(0, 0.5),
                 tumble = random.Uniform(0, 1);
    const int frames = static_cast<int>(random.Integer(1, 40));
    std::vector<Pose> plan;
    for (int i = 0; i < frames; ++i) {
      Pose pose = At({way * random.Normal(), height * (i + 1) / frames, way * random.Normal()});
      for (double& angle : pose.rotations.reshaped()) angle += tumble * random.Normal();
      plan.push_back(pose);
    }
    FootworkContext context = Context();
    context.keyed = random.Uniform() < 0.5;
    context.has_path = random.Uniform() < 0.3;
    StandOnFeet(context, &plan);
    for (size_t i = 0; i < plan.size(); ++i) {
      ASSERT_TRUE(plan[i].root_position.allFinite() && plan[i].rotations.allFinite())
          << "seed " << seed << ", frame " << i;
      ASSERT_LT(plan[i].root_position.norm(), 20) << "seed " << seed << ", frame " << i;
    }
  }
}

}  // namespace choreo::footwork_test
