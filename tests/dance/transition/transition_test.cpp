#include "model/dance/transition/transition.h"

#include <gtest/gtest.h>

#include "model/core/error.h"
#include "model/motion/pose/body_limits.h"
#include "model/plan/takes.h"
#include "tests/dance/poses.h"
#include "tests/support/expect_error.h"
#include "tests/support/fake_sampler.h"

namespace choreo::transition_test {

TransitionSpec RandomRequest(uint32_t seed) {
  std::mt19937 random(seed);
  TransitionSpec request;
  request.frames = 30;
  request.history = MotionTo(RandomPose(random), 10, random);
  request.target = Target{RandomPose(random), {}};
  request.seed = seed;
  return request;
}

TEST(Transition, FewerHistoryPosesHoldTheEarliest) {
  const FakeSampler sampler;
  std::mt19937 random(1);
  const std::vector<Pose> poses = MotionTo(RandomPose(random), 12, random);
  const std::vector<Pose> none = FillHistory(sampler.model(), {});
  ASSERT_EQ(none.size(), 10u);
  EXPECT_TRUE(SameBits(none[0], RoundToFloat(StandingPose(Skeleton::Smpl24()))));
  const std::vector<Pose> three = FillHistory(sampler.model(), std::span(poses).first(3));
  for (size_t i = 0; i < 8; ++i) EXPECT_TRUE(SameBits(three[i], RoundToFloat(poses[0])));
  EXPECT_TRUE(SameBits(three[9], RoundToFloat(poses[2])));
  const std::vector<Pose> last = FillHistory(sampler.model(), poses);
  for (size_t i = 0; i < 10; ++i) EXPECT_TRUE(SameBits(last[i], RoundToFloat(poses[i + 2])));
}

TEST(Transition, SpecIsInTheCanonicalFrame) {
  const FakeSampler sampler;
  TransitionSpec request = RandomRequest(2);
  // Some joints wound up by whole turns, as after many pirouettes.
  for (Pose& pose : request.history) {
    const Eigen::Vector3d w = pose.rotations.col(5);
    pose.rotations.col(5) = w * (1 + 4 * 3.14159265358979 / w.norm());
  }
  const TransitionRun run(sampler.model(), request);
  const std::vector<Pose>& history = run.spec().history;
  ASSERT_EQ(history.size(), 10u);
  EXPECT_NEAR(history.back().root_position.x(), 0, 1e-9);
  EXPECT_NEAR(history.back().root_position.z(), 0, 1e-9);
  EXPECT_NEAR(Heading(ExpMap(history.back().rotations.col(0))), 0, 1e-9);
  for (int joint = 0; joint < 24; ++joint) {
    EXPECT_LE(history.back().rotations.col(joint).norm(), 3.1416);
    for (size_t i = 1; i < history.size(); ++i) {
      EXPECT_LT((history[i].rotations.col(joint) - history[i - 1].rotations.col(joint)).norm(),
                0.3);
    }
  }
  // Relative to the new origin, the target is unchanged.
  const GroundFrame ground = GroundFrame::Of(RoundToFloat(request.history.back()));
  EXPECT_LT(ComparePoses(Skeleton::Smpl24(), ground.ToWorld(run.spec().target->pose),
                         request.target->pose)
                .position_m,
            1e-9);
}

// The floor stops a body, so it slows down before.
TEST(Transition, AKeyOnTheFloorIsReachedAtRest) {
  FakeSampler sampler;
  TransitionSpec request = RandomRequest(3);
  request.history.assign(10, StandingPose(Skeleton::Smpl24()));
  request.target->pose = request.history.back();
  request.footwork = false;  // it would lift legs out of the floor
  const auto last_step = [&](double down) {
    request.target->pose.root_position.y() = request.history.back().root_position.y() - down;
    const std::vector<DanceFrame> frames = DanceTransition(sampler, request).frames();
    return frames[frames.size() - 2].pose.root_position.y() - frames.back().pose.root_position.y();
  };
  constexpr double kToTheSeat = 0.8, kToTheKnees = 0.3;
  EXPECT_GT(last_step(kToTheKnees), 0.5 * kToTheKnees / request.frames) << "on its feet still";
  EXPECT_LT(last_step(kToTheSeat), 0.3 * kToTheSeat / request.frames);
}

// Only the path leads the root, also when it comes to rest.
TEST(Transition, AKeyHitOnAPathIsWhereThePathEnds) {
  ControlledSampler sampler;
  TransitionSpec request = RandomRequest(4);
  request.hit = 1;
  request.target->mask.root_position = false;
  const Eigen::Vector3d from = request.history.back().root_position;
  Eigen::Matrix3Xd path(3, request.frames);
  for (int i = 0; i < request.frames; ++i)
    path.col(i) = from + std::min(0.02 * (i + 1), 0.5) * Eigen::Vector3d::UnitZ();
  request.controls[kRootPath].values = path;
  const std::vector<DanceFrame> frames = DanceTransition(sampler, request).frames();
  const auto root = [&](size_t back) { return frames[frames.size() - back].pose.root_position; };
  EXPECT_LT((root(1) - path.rightCols<1>()).norm(), 1e-3);
  EXPECT_LT((root(1) - root(2)).norm(), 1e-3);
}

// Throws an arm in its first samples.
class WildSampler : public FakeSampler {
 public:
  explicit WildSampler(int wild) : wild_(wild) {}
  int samples() const { return samples_; }

 private:
  void OnFrame(const TransitionSpec& /*spec*/, Plan* plan) override {
    if (plan->poses.size() == 1) ++samples_;
    if (plan->poses.size() == 10 && samples_ <= wild_)
      plan->poses.back().rotations.col(Skeleton::Smpl24().Find("left_shoulder")).z() += 2;
  }

  const int wild_;
  int samples_ = 0;
};

double FastestJoint(const TransitionSpec& request, const TransitionRun& run) {
  std::vector<Pose> poses;
  for (const DanceFrame& frame : run.frames()) poses.push_back(frame.pose);
  return FindFastestStep(Skeleton::Smpl24(), request.history.back(), poses, kModelFps).m_per_s;
}

TEST(Transition, WhatNoBodyCanDoIsSampledAgain) {
  TransitionSpec request = RandomRequest(6);
  request.frames = 60;
  request.candidate = 3;
  for (const int wild : {0, 1, 3}) {
    WildSampler sampler(wild);
    const TransitionRun run = DanceTransition(sampler, request);
    EXPECT_EQ(sampler.samples(), wild + 1);
    EXPECT_LT(FastestJoint(request, run), kFastestJoint);
    EXPECT_EQ(run.spec().candidate, 3u);
    EXPECT_LT(run.arrival()->final_error_m, 1e-5);
  }
  WildSampler always(100);
  EXPECT_GT(FastestJoint(request, DanceTransition(always, request)), kFastestJoint);
  EXPECT_EQ(always.samples(), 5);
}

// Samples its frames twice if it may, and the transition samples it again.
class TwiceSampler : public FakeSampler {
 public:
  int frames = 0;

 private:
  void OnFrame(const TransitionSpec& spec, Plan* plan) override {
    plan->resampled = std::min(spec.frames, spec.spare_frames);
    plan->poses.back().rotations.col(16).z() += plan->poses.size() % 2 == 0 ? 2 : 0;
    if (std::ssize(plan->poses) == spec.frames) frames += spec.frames + plan->resampled;
  }
};

TEST(Transition, SamplesAtMostItsBudgetWhoeverSpendsIt) {
  TransitionSpec request = RandomRequest(6);
  request.frames = 60;
  TwiceSampler sampler;
  ASSERT_GT(FastestJoint(request, DanceTransition(sampler, request)), kFastestJoint);
  EXPECT_EQ(sampler.frames, kMaxTakes * request.frames);
}

TEST(Transition, AKeyThatDemandsTooMuchIsSampledOnce) {
  TransitionSpec request = RandomRequest(6);
  request.frames = 2;
  WildSampler sampler(0);
  EXPECT_GT(FastestJoint(request, DanceTransition(sampler, request)), kFastestJoint);
  EXPECT_EQ(sampler.samples(), 1);
}

// Never keeps still.
class SwayingSampler : public FakeSampler {
  void OnFrame(const TransitionSpec& /*spec*/, Plan* plan) override {
    plan->poses.back().rotations.col(0).z() += plan->poses.size() % 2 == 0 ? 0.02 : -0.02;
  }
};

// How far a dance to a request's target leads away from where it begins, at most: radians, metres.
double Farthest(const TransitionSpec& request) {
  SwayingSampler sampler;
  const Pose& from = request.history.back();
  double farthest = 0;
  const TransitionRun run = DanceTransition(sampler, request);
  for (const DanceFrame& frame : run.frames()) {
    farthest = std::max({farthest, (frame.pose.rotations - from.rotations).norm(),
                         (frame.pose.root_position - from.root_position).norm()});
  }
  return farthest;
}

// In each of its short transitions the model danced away from a held pose and back.
TEST(Transition, OnlyAHeldPoseIsStill) {
  constexpr double kStill = 1e-5;
  std::mt19937 random(5);
  TransitionSpec request;
  request.footwork = false;
  request.temperature = 0.8F;
  request.history.assign(10, RandomPose(random));
  request.target = Target{request.history.back(), {}};
  request.frames = 6;
  EXPECT_LT(Farthest(request), kStill);
  request.frames = 30;  // time to dance away and back
  EXPECT_GT(Farthest(request), 100 * kStill);
  request.frames = 6;
  request.target->pose.root_position.x() += 0.3;  // aside
  EXPECT_GT(Farthest(request), 100 * kStill);
  request.target->mask.root_position = false;
  EXPECT_LT(Farthest(request), kStill);
  request.target = Target{RandomPose(random), {}};
  EXPECT_GT(Farthest(request), 100 * kStill);
}

// A repeated key without a place once let a held pose glide by up to a metre.
TEST(Transition, AHeldPoseKeepsItsPlace) {
  const FakeSampler sampler;
  TransitionSpec request = RandomRequest(5);
  request.target->mask.root_position = false;
  EXPECT_FALSE(TransitionRun(sampler.model(), request).spec().target->mask.root_position);
  request.target->pose.rotations = request.history.back().rotations;
  const TransitionRun held(sampler.model(), request);
  EXPECT_TRUE(held.spec().target->mask.root_position);
  EXPECT_LT(
      (held.spec().target->pose.root_position - held.spec().history.back().root_position).norm(),
      1e-6);
  request.target->mask.joints.assign(24, true);
  request.target->mask.joints[16] = false;  // an open arm moves the body
  EXPECT_FALSE(TransitionRun(sampler.model(), request).spec().target->mask.root_position);
}

// Footwork takes 300 frames at once; of 301 it left one frame in which the pelvis was to get to
// the key.
TEST(Transition, ALongPlanReachesItsKeyWithoutADash) {
  FakeSampler sampler;
  const auto hardest = [&](int frames) {
    TransitionSpec request;
    request.frames = frames;
    request.temperature = 0;
    Pose leaning = StandingPose(sampler.model().skeleton);
    leaning.rotations.col(0).z() = 0.3;  // which footwork balances by the pelvis, but not in keys
    request.history.assign(10, leaning);
    request.target = Target{leaning, {}};
    const TransitionRun run = DanceTransition(sampler, request);
    double most = 0;
    for (size_t i = run.frames().size() - 20; i + 1 < run.frames().size(); ++i) {
      const auto root = [&](size_t at) { return run.frames()[at].pose.root_position; };
      most = std::max(most, (root(i + 1) - 2 * root(i) + root(i - 1)).norm());
    }
    return most;
  };
  const double usual = hardest(300);
  for (const int frames : {301, 302, 305}) EXPECT_LT(hardest(frames), 1.5 * usual) << frames;
}

TEST(Transition, FramesAreFloatsAndHitTheKey) {
  FakeSampler sampler;
  const TransitionSpec request = RandomRequest(3);
  const TransitionRun run = DanceTransition(sampler, request);
  const std::vector<DanceFrame>& frames = run.frames();
  const auto& arrival = run.arrival();
  ASSERT_EQ(frames.size(), 30u);
  for (const DanceFrame& frame : frames) {
    EXPECT_TRUE(SameBits(frame.pose, RoundToFloat(frame.pose)));
  }
  ASSERT_TRUE(arrival);
  EXPECT_LT(arrival->final_error_m, 1e-5);
  EXPECT_LT(arrival->final_error_deg, 1e-3);
  EXPECT_GT(arrival->raw_error_m, arrival->final_error_m);
}

TEST(Transition, AHitComesToRestInTheKeyLateOrGently) {
  FakeSampler sampler;
  const Skeleton& skeleton = Skeleton::Smpl24();
  const auto dance = [&](std::optional<double> hit) {
    TransitionSpec request = RandomRequest(3);
    request.hit = hit;
    return DanceTransition(sampler, request);
  };
  // The way from a frame before the key to it.
  const auto left = [&](const TransitionRun& run, size_t before) {
    const auto& frames = run.frames();
    return ComparePoses(skeleton, frames[frames.size() - 1 - before].pose, frames.back().pose)
        .position_m;
  };
  const TransitionRun through = dance({});
  for (const double hit : {0.0, 1.0, 3.0}) {
    const TransitionRun run = dance(hit);
    EXPECT_LT(run.arrival()->final_error_m, 1e-5) << hit;
    EXPECT_LT(left(run, 1), 0.8 * left(through, 1)) << hit;
  }
  EXPECT_LT(left(dance(0), 8), left(dance(1), 8));
  EXPECT_LT(left(dance(1), 8), left(dance(3), 8));
}

// Rises steadily.
class RisingSampler : public FakeSampler {
  void OnFrame(const TransitionSpec& spec, Plan* plan) override {
    plan->poses.back().root_position.y() =
        spec.history.back().root_position.y() + 0.01 * static_cast<double>(plan->poses.size());
  }
};

// The pelvis kept its height's own time where no path sets it: knees bent before the body sank.
TEST(Transition, AHitMovesHeightsInTimeToo) {
  RisingSampler sampler;
  TransitionSpec request = RandomRequest(3);
  request.footwork = false;
  const auto height = [&](double hit) {
    request.hit = hit;
    return DanceTransition(sampler, request).frames()[22].pose.root_position.y();
  };
  EXPECT_GT(height(0), height(1) + 0.005);
  EXPECT_LT(height(3), height(1) - 0.005);
}

TEST(Transition, WithArrivalOffTheRawErrorIsTheErrorOfTheFrames) {
  FakeSampler sampler;
  TransitionSpec request = RandomRequest(4);
  request.arrival_frames = 0;
  request.footwork = false;
  request.temperature = 1;
  const TransitionRun run = DanceTransition(sampler, request);
  const std::vector<DanceFrame>& frames = run.frames();
  const auto& arrival = run.arrival();
  ASSERT_TRUE(arrival);
  const PoseError error =
      ComparePoses(Skeleton::Smpl24(), frames.back().pose, request.target->pose);
  EXPECT_GT(error.position_m, 1e-3);
  EXPECT_NEAR(arrival->raw_error_m, error.position_m, 1e-6);
  EXPECT_NEAR(arrival->final_error_m, error.position_m, 1e-12);
  EXPECT_EQ(arrival->correction_m, 0);
}

TEST(Transition, MeasuresRequiredSpeeds) {
  const FakeSampler sampler;
  TransitionSpec request;
  request.frames = 15;
  Pose pose = RestPose(Skeleton::Smpl24());
  request.history = {pose};
  pose.root_position.z() += 3;
  pose.rotations.col(18) = Eigen::Vector3d(0, 2, 0);
  request.target = Target{pose, {}};
  RequiredSpeed speed = *TransitionRun(sampler.model(), request).required_speed();
  EXPECT_NEAR(speed.root_m_per_s, 6, 1e-5);
  EXPECT_NEAR(speed.joint_rad_per_s, 4, 1e-5);
  EXPECT_EQ(speed.joint, 18);
  EXPECT_TRUE(speed.TooFast());
  request.target->mask.root_position = false;
  speed = *TransitionRun(sampler.model(), request).required_speed();
  EXPECT_EQ(speed.root_m_per_s, 0);
  EXPECT_FALSE(speed.TooFast());
  request.target.reset();
  EXPECT_FALSE(TransitionRun(sampler.model(), request).required_speed());
}

TEST(Transition, RefusesRequestsOfTheWrongShape) {
  const FakeSampler sampler;
  const auto field = [&sampler](const std::function<void(TransitionSpec&)>& spoil) -> std::string {
    TransitionSpec request = RandomRequest(5);
    spoil(request);
    try {
      TransitionRun run(sampler.model(), request);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
      return error.field();
    }
    return "accepted";
  };
  const Pose other{Eigen::Vector3d::Zero(), Eigen::Matrix3Xd::Zero(3, 23)};
  EXPECT_EQ(field([](TransitionSpec&) {}), "accepted");
  EXPECT_EQ(field([](TransitionSpec& r) { r.frames = 0; }), "frames");
  EXPECT_EQ(field([](TransitionSpec& r) { r.frames = 1801; }), "frames");
  EXPECT_EQ(field([&](TransitionSpec& r) { r.history[3] = other; }), "history[3].rotations");
  EXPECT_EQ(field([&](TransitionSpec& r) { r.target->pose = other; }), "target.rotations");
  EXPECT_EQ(field([&](TransitionSpec& r) { r.after = other; }), "after.rotations");
  EXPECT_EQ(field([](TransitionSpec& r) {
              r.after = r.target->pose;
              r.target.reset();
            }),
            "after");
}

/// Spoils its plan after the last frame.
class OddSampler final : public FakeSampler {
 public:
  explicit OddSampler(void (*spoil)(Plan&)) : spoil_(spoil) {}
  void OnFrame(const TransitionSpec& spec, Plan* plan) override {
    if (plan->poses.size() == static_cast<size_t>(spec.frames)) spoil_(*plan);
  }

 private:
  void (*spoil_)(Plan&);
};

TEST(Transition, RefusesAPlanOfAnotherLength) {
  for (void (*spoil)(Plan&) : {+[](Plan& plan) { plan.poses.push_back(plan.poses.back()); },
                               +[](Plan& plan) { plan.contacts.pop_back(); },
                               +[](Plan& plan) { plan.log_likelihoods.pop_back(); }}) {
    OddSampler sampler(spoil);
    ExpectError(ErrorCode::kInternal, "the model's plan of 30 frames has ",
                [&] { DanceTransition(sampler, RandomRequest(4)); });
  }
  OddSampler unlikely([](Plan& plan) { plan.log_likelihoods.clear(); });
  EXPECT_EQ(DanceTransition(unlikely, RandomRequest(4)).frames().size(), 30U);
}

TEST(BeatsAround, IncludeOneOnEitherSideOfTheTransition) {
  const std::vector<double> seconds = {1, 2, 3, 4, 5};
  EXPECT_EQ(BeatsAround(seconds, 30, 75, 30), (std::vector<double>{-15, 15, 45}));
  EXPECT_EQ(BeatsAround(seconds, 30, 60, 1), (std::vector<double>{-30, 0, 30}));
  EXPECT_EQ(BeatsAround(seconds, 30, 0, 10), (std::vector<double>{30}));
  EXPECT_EQ(BeatsAround(seconds, 30, 300, 10), (std::vector<double>{-150}));
  EXPECT_TRUE(BeatsAround({}, 30, 0, 10).empty());
}

}  // namespace choreo::transition_test
