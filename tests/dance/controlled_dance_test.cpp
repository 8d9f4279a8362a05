#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/dance/transition_group.h"
#include "tests/dance/dances.h"
#include "tests/support/expect_error.h"

namespace choreo::controlled_dance_test {

using testing::HasSubstr;

/// Over the floor from x0 to x1, metres, at an angle of 45 degrees.
ControlRequest PathRequest(int64_t from, int64_t to, double x0, double x1) {
  ControlRequest request;
  request.root_path.emplace().frames = {from, to};
  request.root_path->points = {{x0, x0}, {x1, x1}};
  return request;
}

ControlRequest Factor(BodyPart part, float factor) {
  ControlRequest request;
  request.velocity_factors.emplace().parts.emplace_back(kBodyPartNames[static_cast<size_t>(part)]);
  request.velocity_factors->factors = {factor};
  return request;
}

/// The fake model's record of the factor requested for the left arm.
double LeftArm(const Pose& pose) {
  return pose.rotations(0, Skeleton::Smpl24().Find(kTellingJoints[1]));
}

class ControlledDanceTest : public testing::Test {
 protected:
  Recording Perform(const std::function<void(DanceStream&)>& messages, int64_t frames = 300) {
    return Perform(messages, std::make_shared<Recorder>(), frames);
  }
  Recording Perform(const std::function<void(DanceStream&)>& messages,
                    const std::shared_ptr<Recorder>& sink, int64_t frames = 300) {
    config_.end_frame = frames;
    DanceStream stream(*queue_, Checked(*queue_, config_), sink);
    messages(stream);
    stream.HalfClose();
    return sink->WaitForEnd();
  }

  static Pose KeyAt(double x, double z) {
    Pose pose = RestPose(Skeleton::Smpl24());
    pose.root_position.x() = x;
    pose.root_position.z() = z;
    return pose;
  }

  const std::unique_ptr<SampleQueue> queue_ = QueueOf<ControlledSampler>();
  DanceConfig config_;
};

TEST_F(ControlledDanceTest, FollowsAPathOverManyTransitions) {
  const Recording dance = Perform([](DanceStream& s) { s.SetControls(PathRequest(0, 299, 0, 2)); });
  ASSERT_TRUE(dance.summary) << dance.error->what();
  EXPECT_GE(dance.continuations.size(), 5u);
  for (int frame = 20; frame < 300; ++frame) {
    EXPECT_NEAR(dance.poses[static_cast<size_t>(frame)].root_position.x(), 2.0 * frame / 299, 1e-5);
    EXPECT_NEAR(dance.poses[static_cast<size_t>(frame)].root_position.z(), 2.0 * frame / 299, 1e-5);
  }
  EXPECT_TRUE(dance.warnings.empty());
}

TEST_F(ControlledDanceTest, StartsAtTheStartOfThePath) {
  for (const bool key : {false, true}) {
    const Recording dance = Perform([key](DanceStream& s) {
      s.SetControls(PathRequest(0, 299, -5, -4));
      if (!key) return;
      s.SetKey({.id = "first", .pose = KeyAt(0, 0), .mask = {.root_position = false, .joints = {}}},
               AtFrame{0});
    });
    ASSERT_TRUE(dance.summary) << dance.error->what();
    EXPECT_TRUE(dance.warnings.empty()) << dance.warnings[0].message;
    EXPECT_NEAR(dance.poses[0].root_position.x(), -5, 1e-3);
    EXPECT_NEAR(dance.poses[0].root_position.z(), -5, 1e-3);
  }
}

TEST_F(ControlledDanceTest, WarnsOfAPathAfterTheEnd) {
  const Recording dance =
      Perform([](DanceStream& s) { s.SetControls(PathRequest(120, 240, 0, 1)); }, 120);
  ASSERT_TRUE(dance.summary) << dance.error->what();
  ASSERT_EQ(dance.warnings.size(), 1u);
  EXPECT_EQ(dance.warnings[0].code, Warning::Code::kPathBehindEnd);
}

TEST_F(ControlledDanceTest, ControlsApplyFromTheFirstUnfrozenFrame) {
  const Recording dance = Perform([](DanceStream& s) {
    s.SetControls(Factor(BodyPart::kLeftArm, 2));
    s.GenerateUntil(100);
    s.SetControls(Factor(BodyPart::kLeftArm, 3));
    s.SetControls(Factor(BodyPart::kRightArm, 1));
    s.GenerateUntil(200);
    s.SetControls(Factor(BodyPart::kLeftArm, 4));
  });
  ASSERT_TRUE(dance.summary) << dance.error->what();
  EXPECT_NEAR(LeftArm(dance.poses[99]), 0.04, 1e-6);
  EXPECT_NEAR(LeftArm(dance.poses[100]), 0.06, 1e-6);
  EXPECT_NEAR(LeftArm(dance.poses[199]), 0.06, 1e-6);
  EXPECT_NEAR(LeftArm(dance.poses[200]), 0.08, 1e-6);
  EXPECT_NEAR(LeftArm(dance.poses[299]), 0.08, 1e-6);
}

TEST_F(ControlledDanceTest, WithoutGenerateUntilControlsApplyAfterTheLastKey) {
  const Recording dance = Perform([](DanceStream& s) {
    s.SetKey({.id = "a", .pose = KeyAt(0, 0)}, AtFrame{80});
    s.SetControls(Factor(BodyPart::kLeftArm, 5));
  });
  ASSERT_TRUE(dance.summary) << dance.error->what();
  EXPECT_LT(LeftArm(dance.poses[80]), 0.02);
  EXPECT_NEAR(LeftArm(dance.poses[81]), 0.1, 1e-6);
}

TEST_F(ControlledDanceTest, KeysAreHitAndPathsBendToThem) {
  const Recording dance = Perform([](DanceStream& s) {
    s.SetControls(PathRequest(0, 299, 0, 2));
    s.SetKey({.id = "beside", .pose = KeyAt(1.5, 1)}, AtFrame{150});
    s.SetKey({.id = "on", .pose = KeyAt(2.0 * 240 / 299, 2.0 * 240 / 299)}, AtFrame{240});
  });
  ASSERT_TRUE(dance.summary) << dance.error->what();
  ASSERT_EQ(dance.reached.size(), 2u);
  for (const KeyReached& key : dance.reached) EXPECT_LT(key.final_error_m, 1e-3);
  ASSERT_EQ(dance.warnings.size(), 1u);
  EXPECT_EQ(dance.warnings[0].code, Warning::Code::kKeyOffPath);
  EXPECT_THAT(dance.warnings[0].message, HasSubstr("key \"beside\" lies 0.5"));
  // Neither on the way there nor back is there a jump.
  for (size_t i = 1; i < dance.poses.size(); ++i) {
    EXPECT_LT((dance.poses[i].root_position - dance.poses[i - 1].root_position).norm(), 0.05) << i;
  }
}

// Repeats a pose, as clients send holds.
TEST_F(ControlledDanceTest, APathWaitsWhileAPoseIsHeld) {
  Pose pose = KeyAt(1.1, 1.1);
  pose.rotations(2, 16) = 1;
  const double on_path = 3.0 * 120 / 299;
  for (const bool has_place : {false, true}) {
    const PoseMask mask{.root_position = has_place, .joints = {}};
    const Recording dance = Perform([&](DanceStream& s) {
      s.SetControls(PathRequest(0, 299, 0, 3));
      for (const int64_t frame : {120, 126, 132, 138, 144, 150})
        s.SetKey({.id = std::to_string(frame),
                  .pose = pose,
                  .mask = mask,
                  .hit = frame == 120 ? std::optional(1.0) : std::nullopt},
                 AtFrame{frame});
    });
    ASSERT_TRUE(dance.summary) << dance.error->what();
    // The key is off the path; the keys that hold it stay at its place.
    EXPECT_EQ(dance.warnings.size(), has_place ? 1u : 0u);
    const double stands = has_place ? 1.1 : on_path;
    for (size_t frame = 120; frame <= 150; ++frame)
      EXPECT_NEAR(dance.poses[frame].root_position.x(), stands, 1e-3) << frame;
    EXPECT_NEAR(dance.poses[240].root_position.x(), 3.0 * 240 / 299, 1e-3);
    // The dancer stops and starts without a jerk: 0.3 m/s in a frame are 9 m/s^2.
    Eigen::Vector3d step = dance.poses[100].root_position - dance.poses[99].root_position;
    for (size_t frame = 101; frame < 240; ++frame) {
      const Eigen::Vector3d next =
          dance.poses[frame].root_position - dance.poses[frame - 1].root_position;
      EXPECT_LT((next - step).norm(), 0.01) << frame;
      step = next;
    }
  }
}

TEST_F(ControlledDanceTest, AKeyWithoutAPlaceStandsOnTheFloor) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  Pose crouch = RestPose(skeleton);
  for (const int hip : {skeleton.left_hip, skeleton.right_hip}) crouch.rotations(0, hip) = -1.1;
  for (const int knee : {skeleton.left_knee, skeleton.right_knee}) crouch.rotations(0, knee) = 1.8;
  for (const int ankle : {skeleton.feet[0], skeleton.feet[2]}) crouch.rotations(0, ankle) = -0.7;
  const PoseMask nowhere{.root_position = false, .joints = {}};
  const double toes_at_rest = JointPositions(skeleton, RestPose(skeleton)).row(1).minCoeff();
  const auto lowest_foot = [&](const Pose& pose) {
    const Eigen::Matrix3Xd joints = JointPositions(skeleton, pose);
    double lowest = 9;
    for (const int foot : skeleton.feet) lowest = std::min(lowest, joints(1, foot));
    return lowest - toes_at_rest;
  };
  for (const int64_t first : {0, 40}) {  // the first one may stand where the dance begins
    for (const bool path : {true, false}) {
      const Recording dance = Perform([&](DanceStream& s) {
        if (path) s.SetControls(PathRequest(0, 299, 0, 2));
        s.SetKey({.id = "crouch", .pose = crouch, .mask = nowhere}, AtFrame{first});
        s.SetKey({.id = "up", .pose = RestPose(skeleton), .mask = nowhere}, AtFrame{100});
        s.SetKey({.id = "again", .pose = crouch, .mask = nowhere}, AtFrame{160});
      });
      ASSERT_TRUE(dance.summary) << dance.error->what();
      EXPECT_TRUE(dance.warnings.empty());
      for (const int64_t frame : {first, int64_t{100}, int64_t{160}}) {
        EXPECT_NEAR(lowest_foot(dance.poses[static_cast<size_t>(frame)]), 0, 0.01)
            << frame << (path ? " on a path" : "");
      }
    }
  }
  // A path with heights takes precedence.
  ControlRequest jump = PathRequest(0, 299, 0, 2);
  jump.root_path->heights = {1.2, 1.2};
  const Recording high = Perform([&](DanceStream& s) {
    s.SetControls(jump);
    s.SetKey({.id = "crouch", .pose = crouch, .mask = nowhere}, AtFrame{100});
  });
  ASSERT_TRUE(high.summary) << high.error->what();
  EXPECT_NEAR(high.poses[100].root_position.y(), 1.2, 1e-5);
}

// Footwork plans a transition's last steps to the key's feet. A key without a place stands on the
// path.
TEST_F(ControlledDanceTest, FeetLandWhereAKeyWithoutAPlaceStandsOnThePath) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  Pose soft = RestPose(skeleton);
  for (const int hip : {skeleton.left_hip, skeleton.right_hip}) soft.rotations(0, hip) = -0.25;
  for (const int knee : {skeleton.left_knee, skeleton.right_knee}) soft.rotations(0, knee) = 0.5;
  for (const int ankle : {skeleton.feet[0], skeleton.feet[2]}) soft.rotations(0, ankle) = -0.25;
  const Recording dance = Perform([&](DanceStream& s) {
    s.SetControls(PathRequest(0, 299, 0, 5));  // 0.7 m/s
    for (const int64_t frame : {59, 119, 179, 239, 299})
      s.SetKey({.id = "at " + std::to_string(frame),
                .pose = soft,
                .mask = {.root_position = false, .joints = {}}},
               AtFrame{frame});
  });
  ASSERT_TRUE(dance.summary) << dance.error->what();
  EXPECT_TRUE(dance.warnings.empty());
  EXPECT_LT(dance.summary->skate_ratio, 0.2);  // 0.7 where they glide
  EXPECT_NEAR(dance.poses[179].root_position.x(), 5.0 * 179 / 299, 1e-3);
}

TEST_F(ControlledDanceTest, DoesNotDependOnWhenMessagesCome) {
  const auto messages = [](DanceStream& s, const std::function<void(size_t)>& granted) {
    s.SetControls(PathRequest(0, 200, 0, 1));
    s.GenerateUntil(70);
    granted(70);
    s.SetControls(PathRequest(50, 250, 0.5, -1));
    s.SetControls(Factor(BodyPart::kTrunk, 0.5F));
    s.GenerateUntil(200);
    granted(200);
    s.SetKey({.id = "end", .pose = KeyAt(-1, 0)}, AtFrame{280});
  };
  const Recording at_once = Perform([&](DanceStream& s) { messages(s, [](size_t) {}); });
  auto sink = std::make_shared<Recorder>();
  const Recording slowly = Perform(
      [&](DanceStream& s) { messages(s, [&](size_t frames) { sink->WaitForFrames(frames); }); },
      sink);
  ASSERT_TRUE(at_once.summary && slowly.summary);
  EXPECT_TRUE(SameDance(at_once, slowly));
}

TEST_F(ControlledDanceTest, ResumesBitForBitWhereverItBroke) {
  const auto messages = [](DanceStream& s) {
    s.SetControls(PathRequest(20, 200, 0, 1));
    s.SetControls(Factor(BodyPart::kLeftArm, 1.5F));
    s.GenerateUntil(70);
    s.SetControls(PathRequest(50, 250, 0.5, -1));
    s.SetKey({.id = "a", .pose = KeyAt(0.2, 0)}, AtFrame{130});
    s.GenerateUntil(140);
    s.SetControls(Factor(BodyPart::kLeftLeg, 0));
    s.SetControls(PathRequest(10, 60, 0, 0));  // too late
    s.GenerateUntil(200);
  };
  const Recording whole = Perform(messages);
  ASSERT_TRUE(whole.summary) << whole.error->what();
  ASSERT_GE(whole.continuations.size(), 4u);
  // The speeds of parts are measured from the resume on.
  const auto told = [](const Recording& dance) {
    return dance.warnings.size() -
           static_cast<size_t>(
               std::ranges::count(dance.warnings, Warning::Code::kVelocityNotMet, &Warning::code));
  };
  ASSERT_EQ(told(whole), 2u);  // that, and the key off the path
  for (const Continuation& continuation : whole.continuations) {
    config_.continuation = continuation;
    const Recording rest = Perform(messages);
    ASSERT_TRUE(rest.summary) << rest.error->what();
    if (continuation.frame == 300) continue;
    EXPECT_TRUE(SameDance(whole, rest)) << "from frame " << continuation.frame;
    // Warnings about danced frames are not repeated.
    EXPECT_EQ(told(rest), continuation.frame <= 60 ? 2u : continuation.frame <= 130 ? 1u : 0u);
  }
}

TEST_F(ControlledDanceTest, WarnsOfAPathThatComesTooLate) {
  const Recording dance = Perform([](DanceStream& s) {
    s.GenerateUntil(100);
    s.SetControls(PathRequest(10, 90, 0, 1));
  });
  ASSERT_EQ(dance.warnings.size(), 1u);
  EXPECT_EQ(dance.warnings[0].code, Warning::Code::kControlsTooLate);
  EXPECT_THAT(dance.warnings[0].message, HasSubstr("ends at 3 s, and all before 3.33 s"));
}

TEST_F(ControlledDanceTest, BadControlsLeaveTheDanceAsItIs) {
  const Recording dance = Perform([](DanceStream& s) {
    s.SetControls(Factor(BodyPart::kLeftArm, 2));
    ExpectError(ErrorCode::kInvalidArgument, "controls.velocity_factors.factors[0]: -1",
                [&] { s.SetControls(Factor(BodyPart::kLeftArm, -1)); });
    s.SetPaused(true);  // a dance that is over would take no notice
    s.KeysComplete();
    ExpectError(ErrorCode::kInvalidArgument, "controls: comes after the keys are complete",
                [&] { s.SetControls(Factor(BodyPart::kLeftArm, 1)); });
    s.SetPaused(false);
  });
  ASSERT_TRUE(dance.summary) << dance.error->what();
  EXPECT_NEAR(LeftArm(dance.poses.back()), 0.04, 1e-6);
}

TEST_F(ControlledDanceTest, MovingTheSceneMovesTheDance) {
  const double heading = 1.2;
  const Eigen::Vector3d shift(4, 0, -3);
  std::mt19937 random(4);
  const std::vector<Pose> history = MotionTo(RandomPose(random), 10, random);
  ControlRequest path = PathRequest(10, 250, 0, 2);
  const auto messages = [&](DanceStream& s) { s.SetControls(path); };
  config_.history = history;
  const Recording here = Perform(messages);
  for (Pose& pose : config_.history) pose = Placed(pose, heading, shift);
  for (Eigen::Vector2d& point : path.root_path->points) {
    const Eigen::Vector3d turned =
        HeadingRotation(heading) * Eigen::Vector3d(point.x(), 0, point.y()) + shift;
    point = {turned.x(), turned.z()};
  }
  const Recording there = Perform(messages);
  ASSERT_TRUE(here.summary && there.summary);
  for (size_t i = 0; i < here.poses.size(); ++i) {
    EXPECT_LT(
        (Placed(here.poses[i], heading, shift).root_position - there.poses[i].root_position).norm(),
        1e-4);
  }
}

/// Records a group's answers.
class GroupRecorder : public GroupSink {
 public:
  void OnFrames(int, int64_t, std::span<const Pose> poses, std::span<const Contacts>) override {
    std::lock_guard lock(mutex_);
    recording_.poses.insert(recording_.poses.end(), poses.begin(), poses.end());
  }
  void OnWarning(const Warning& warning) override {
    std::lock_guard lock(mutex_);
    recording_.warnings.push_back(warning);
  }
  void OnDone(std::span<const CandidateReport> ranked) override {
    std::lock_guard lock(mutex_);
    recording_.summary = ranked.front().quality;
    done_.notify_all();
  }
  void OnError(const Error& error) override {
    std::lock_guard lock(mutex_);
    recording_.error = error;
    done_.notify_all();
  }
  Recording Wait() {
    std::unique_lock lock(mutex_);
    done_.wait_for(lock, std::chrono::minutes(1), [&] { return recording_.ended(); });
    return recording_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable done_;
  Recording recording_;
};

TEST_F(ControlledDanceTest, SingleTransitionWarnsOfAPathOutsideIt) {
  for (const auto& [from, kind] : {std::pair{0, Warning::Code::kControlsTooLate},
                                   std::pair{160, Warning::Code::kPathBehindEnd}}) {
    GroupRequest request;
    request.first_frame = 100;
    request.frames = 60;
    request.controls = PathRequest(from, from + 99, 0, 1);
    auto sink = std::make_shared<GroupRecorder>();
    const TransitionGroup group(*queue_, Checked(*queue_, request), sink);
    const Recording transition = sink->Wait();
    ASSERT_EQ(transition.warnings.size(), 1u);
    EXPECT_EQ(transition.warnings[0].code, kind);
  }
}

TEST_F(ControlledDanceTest, SingleTransitionEqualsTheStreams) {
  const ControlRequest path = PathRequest(0, 200, 3, 4);
  const Pose key = KeyAt(3.9, 3.2);
  const Recording dance = Perform(
      [&](DanceStream& s) {
        s.SetControls(path);
        s.SetKey({.id = "target", .pose = key}, AtFrame{89});
      },
      90);
  GroupRequest request;
  request.frames = 90;
  request.target = Target{key, {}};
  request.controls = path;
  auto sink = std::make_shared<GroupRecorder>();
  const TransitionGroup group(*queue_, Checked(*queue_, request), sink);
  const Recording transition = sink->Wait();
  ASSERT_TRUE(dance.summary && transition.summary);
  ASSERT_EQ(transition.poses.size(), dance.poses.size());
  for (size_t i = 0; i < dance.poses.size(); ++i) {
    EXPECT_TRUE(SameBits(dance.poses[i], transition.poses[i])) << i;
  }
  ASSERT_EQ(transition.warnings.size(), 1u);
  EXPECT_EQ(transition.warnings[0].message, dance.warnings.at(0).message);
}

}  // namespace choreo::controlled_dance_test
