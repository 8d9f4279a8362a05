#include "model/dance/dance_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

#include "model/dance/delivery/hand_over.h"
#include "tests/dance/dances.h"

namespace choreo::dance_stream_test {

TEST(DanceStream, HitsEveryKeyAndReportsIt) {
  const auto queue = FakeQueue();
  Dance dance = RandomDance(11);
  const Recording recording = Perform(*queue, dance);
  ASSERT_TRUE(recording.summary) << recording.error->what();
  EXPECT_TRUE(recording.in_order);
  EXPECT_EQ(recording.calls_after_end, 0);
  EXPECT_EQ(recording.first_frame, 0);
  ASSERT_EQ(recording.poses.size(), static_cast<size_t>(dance.keys.back().frame + 1));
  ASSERT_EQ(recording.reached.size(), dance.keys.size());
  for (size_t i = 0; i < dance.keys.size(); ++i) {
    const Key& key = dance.keys[i];
    EXPECT_EQ(recording.reached[i].id, key.id);
    EXPECT_EQ(recording.reached[i].frame, key.frame);
    const Pose& danced = recording.poses[static_cast<size_t>(key.frame)];
    const PoseError error = ComparePoses(Skeleton::Smpl24(), danced, key.pose, key.mask);
    EXPECT_LT(error.position_m, 1e-4);
    EXPECT_LT(error.angle_deg, 1e-2);
    EXPECT_DOUBLE_EQ(recording.reached[i].final_error_m, error.position_m);
    EXPECT_GT(recording.reached[i].raw_error_m, 0);
    EXPECT_GE(recording.reached[i].correction_m, recording.reached[i].raw_error_m * 0.5);
    EXPECT_EQ(recording.summary->keys[i].id, key.id);
  }
  EXPECT_EQ(recording.summary->frames, dance.keys.back().frame + 1);
  EXPECT_EQ(recording.continuations.size(), dance.keys.size());
}

TEST(DanceStream, AKeyOnFrameZeroIsTheFirstFrame) {
  const auto queue = FakeQueue();
  std::mt19937 random(3);
  Dance dance;
  dance.keys = {{"start", 0, RandomPose(random), {}}, {"end", 40, RandomPose(random), {}}};
  const Recording recording = Perform(*queue, dance);
  ASSERT_EQ(recording.poses.size(), 41u);
  EXPECT_LT(ComparePoses(Skeleton::Smpl24(), recording.poses[0], dance.keys[0].pose).position_m,
            1e-6);
  EXPECT_TRUE(recording.warnings.empty());  // no jump from the neutral stance
}

TEST(DanceStream, FramesFlowWhileTheMusicStillArrives) {
  const auto queue = QueueOf<FakeSampler>();
  DanceConfig config;
  config.audio = DanceConfig::Audio{22050, 1, 0};
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(*queue, Checked(*queue, config), sink);
  stream.KeysComplete();
  const std::vector<float> samples = Song(22050, 5);
  // Frame r needs samples up to 735 r + 1024, and no more.
  int64_t sent = 0;
  for (int64_t frame : {0, 1, 2, 30, 90}) {
    const int64_t enough = 735 * frame + 1024;
    stream.PushAudio(
        std::span(samples).subspan(static_cast<size_t>(sent), static_cast<size_t>(enough - sent)),
        sent);
    sent = enough;
    const Recording recording = sink->WaitForFrames(static_cast<size_t>(frame) + 1);
    EXPECT_FALSE(recording.ended());
    EXPECT_EQ(recording.poses.size(), static_cast<size_t>(frame) + 1);
  }
}

// It is sampled whole, so all of its music must be there; the sixtieth frame's needs no more.
TEST(DanceStream, ModelWithMusicInputWaitsForItsMusic) {
  const auto queue = FakeQueue();
  DanceConfig config;
  config.audio = DanceConfig::Audio{22050, 1, 0};
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(*queue, Checked(*queue, config), sink);
  stream.KeysComplete();
  const std::vector<float> samples = Song(22050, 3);
  const size_t enough = 735 * (kTypicalFrames - 1) + 1024;
  stream.PushAudio(std::span(samples).first(enough - 1), 0);
  EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_EQ(sink->Snapshot().poses.size(), 0U);
  stream.PushAudio(std::span(samples).subspan(enough - 1, 1), enough - 1);
  EXPECT_EQ(sink->WaitForFrames(kTypicalFrames).poses.size(), static_cast<size_t>(kTypicalFrames));
}

TEST(DanceStream, EndsWithTheMusic) {
  const auto queue = FakeQueue();
  for (double seconds : {0.01, 1.0, 2.345}) {
    Dance dance;
    dance.config.audio = DanceConfig::Audio{44100, 2, 0};
    dance.samples = Song(44100, seconds, 2);
    const Recording recording = Perform(*queue, dance);
    ASSERT_TRUE(recording.summary);
    EXPECT_EQ(recording.poses.size(), static_cast<size_t>(std::ceil(seconds * 30 - 1e-9)));
  }
}

TEST(DanceStream, KeysAfterTheMusicAreReachedInSilence) {
  const auto queue = FakeQueue();
  Dance dance = RandomDance(17, 1.0);
  const Recording recording = Perform(*queue, dance);
  ASSERT_TRUE(recording.summary);
  EXPECT_EQ(recording.reached.size(), dance.keys.size());
}

TEST(DanceStream, ALongDanceWithoutKeysStaysFinite) {
  const auto queue = FakeQueue();
  DanceConfig config;
  config.end_frame = 18'000;  // ten minutes
  config.temperature = 1.0F;
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(*queue, Checked(*queue, config), sink);
  stream.KeysComplete();
  const Recording recording = sink->WaitForEnd();
  ASSERT_TRUE(recording.summary) << recording.error->what();
  ASSERT_EQ(recording.poses.size(), 18'000u);
  for (const Pose& pose : recording.poses) {
    ASSERT_TRUE(pose.root_position.allFinite() && pose.rotations.allFinite());
    ASSERT_LT(pose.root_position.norm(), 1000);
  }
  EXPECT_EQ(recording.continuations.size(), 300u);
  EXPECT_EQ(recording.continuations.back().frame, 18'000);
}

// It may be led away by keys; then it keeps to where they left it.
TEST(DanceStream, StaysNearItsStartOrLastPlace) {
  const auto queue = FakeQueue();
  Dance dance;
  dance.config.temperature = 0;
  Pose start = RestPose(Skeleton::Smpl24()), away = start, armed = start;
  start.root_position.x() = 3;
  away.root_position.z() = -4;
  dance.config.history = {start};
  PoseMask arms{.root_position = false, .joints = std::vector<bool>(24, false)};
  arms.joints[16] = true;
  dance.keys = {{"arms", 60, armed, arms}, {"away", 120, away, {}}, {"end", 240, armed, arms}};
  const std::vector<Pose> poses = Perform(*queue, dance).poses;
  ASSERT_EQ(poses.size(), 241U);
  EXPECT_NEAR(poses[60].root_position.x(), 3, 0.05);
  EXPECT_NEAR(poses[240].root_position.x(), 0, 0.05);
  EXPECT_NEAR(poses[240].root_position.z(), -4, 0.05);
}

TEST(DanceStream, CancellationEndsItOnce) {
  const auto queue = QueueOf<FakeSampler>();
  const auto idle = [&] { return queue->WaitUntilIdle(std::chrono::seconds(30)); };
  for (int how = 0; how < 3; ++how) {
    auto sink = std::make_shared<Recorder>();
    DanceConfig config;
    config.audio = DanceConfig::Audio{22050, 1, 0};
    auto stream = std::make_unique<DanceStream>(*queue, Checked(*queue, config), sink);
    stream->KeysComplete();
    stream->PushAudio(Song(22050, 0.5), 0);  // then it waits for more
    if (how > 0) sink->WaitForFrames(5);
    if (how < 2) stream->Cancel();
    stream.reset();  // cancels too
    const Recording recording = sink->WaitForEnd();
    ASSERT_TRUE(recording.error);
    EXPECT_EQ(recording.error->code(), ErrorCode::kCancelled);
    EXPECT_EQ(recording.calls_after_end, 0);
    EXPECT_TRUE(idle());
  }
  EXPECT_TRUE(Perform(*queue, RandomDance(19)).summary);
}

// The only worker serves the dance that can continue, and the first dance is the same as alone.
TEST(DanceStream, WaitingForMusicBlocksNobody) {
  const auto queue = QueueOf<FakeSampler>();
  DanceConfig config;
  config.audio = DanceConfig::Audio{22050, 1, 0};
  auto first_sink = std::make_shared<Recorder>();
  DanceStream first(*queue, Checked(*queue, config), first_sink);
  first.KeysComplete();
  first.PushAudio(Song(22050, 0.5), 0);
  first_sink->WaitForFrames(1);
  EXPECT_TRUE(Perform(*queue, RandomDance(20)).summary);
  first.PushAudio(Song(22050, 1.5), 11025);
  first.EndOfAudio();
  const Recording interrupted = first_sink->WaitForEnd();
  ASSERT_TRUE(interrupted.summary);

  auto sink = std::make_shared<Recorder>();
  DanceStream alone(*queue, Checked(*queue, config), sink);
  alone.KeysComplete();
  alone.PushAudio(Song(22050, 0.5), 0);
  alone.PushAudio(Song(22050, 1.5), 11025);
  alone.EndOfAudio();
  EXPECT_TRUE(SameDance(sink->WaitForEnd(), interrupted));
}

// One transition ahead, so that it is ready when due; not more, which might never be danced.
TEST(DanceStream, TheNextTransitionIsSampledWhileOneIsHandedOut) {
  const auto queue = FakeQueue();
  const Dance dance = RandomDance(24);
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(*queue, Checked(*queue, dance.config), sink);
  sink->on_frames = [&](size_t count) {
    if (count == 1) stream.SetPaused(true);
  };
  for (const Key& key : dance.keys) SendKey(stream, key);
  stream.KeysComplete();
  sink->WaitForFrames(1);
  EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_EQ(queue->stats().transitions, 2U);
  EXPECT_EQ(sink->Snapshot().poses.size(), 1U);
  stream.SetPaused(false);
  EXPECT_TRUE(sink->WaitForEnd().summary);
  EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_EQ(queue->stats().transitions, dance.keys.size());
}

// The thread may be one of gRPC's, which also serves other calls.
TEST(DanceStream, AThreadThatResumesADanceHandsOutAFewFrames) {
  const auto queue = FakeQueue();
  const auto sink = std::make_shared<Recorder>();
  std::atomic<int> handed_out_here = 0;
  sink->on_frames = [&, here = std::this_thread::get_id()](size_t /*count*/) {
    if (std::this_thread::get_id() == here) ++handed_out_here;
  };
  DanceConfig config;
  config.end_frame = 300;
  DanceStream stream(*queue, Checked(*queue, config), sink);
  stream.SetPaused(true);
  stream.KeysComplete();
  EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));  // two transitions are sampled
  stream.SetPaused(false);
  EXPECT_EQ(sink->WaitForEnd().poses.size(), 300U);
  EXPECT_GT(handed_out_here, 0);
  EXPECT_LE(handed_out_here, kFramesASlice);
}

// A dance releases its listener, however it ends.
TEST(DanceStream, FreesAllOfADance) {
  const auto queue = FakeQueue();
  for (const bool whole : {true, false}) {
    const auto sink = std::make_shared<Recorder>();
    {
      DanceStream stream(*queue, Checked(*queue, DanceConfig()), sink);
      stream.GenerateUntil(10);
      sink->WaitForFrames(10);
      stream.SetKey({.id = "a", .pose = RestPose(Skeleton::Smpl24())}, AtFrame{20});
      if (whole) stream.HalfClose();
      if (whole) sink->WaitForEnd();
    }
    EXPECT_TRUE(sink->WaitForEnd().ended());
    EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));
    EXPECT_EQ(sink.use_count(), 1) << (whole ? "whole" : "cancelled");
  }
}

/// Runs out of memory when it gets a continuation.
class ForgetfulRecorder final : public Recorder {
 public:
  void OnContinuation(const Continuation&) override { throw std::bad_alloc(); }
};

TEST(DanceStream, FailsWhenMemoryRunsOut) {
  const auto queue = FakeQueue();
  auto sink = std::make_shared<ForgetfulRecorder>();
  DanceStream stream(*queue, Checked(*queue, DanceConfig()), sink);
  stream.SetKey({.id = "a", .pose = RestPose(Skeleton::Smpl24())}, AtFrame{20});
  const Recording recording = sink->WaitForEnd();
  ASSERT_TRUE(recording.error);
  EXPECT_EQ(recording.error->code(), ErrorCode::kInternal);
  EXPECT_TRUE(queue->WaitUntilIdle(std::chrono::seconds(30)));
  EXPECT_TRUE(Perform(*queue, RandomDance(20)).summary);
}

/// Gives a pose that is not a number at one frame.
class BrokenSampler : public FakeSampler {
 public:
  void OnFrame(const TransitionSpec&, Plan* plan) override {
    if (++frames_ == 70) plan->poses.back().rotations(1, 5) = std::nan("");
  }

 private:
  int frames_ = 0;
};

// The transitions before the failed one are delivered.
TEST(DanceStream, BrokenModelEndsOnlyItsDance) {
  const auto queue = QueueOf<BrokenSampler>();
  Dance dance = RandomDance(21);
  dance.keys = {{"a", 39, dance.keys[0].pose, {}}, {"b", 99, dance.keys[1].pose, {}}};
  const Recording broken = Perform(*queue, dance);
  ASSERT_TRUE(broken.error);
  EXPECT_EQ(broken.error->code(), ErrorCode::kInternal);
  EXPECT_THAT(broken.error->what(), ::testing::HasSubstr("frame 69"));
  EXPECT_EQ(broken.poses.size(), 40u);
  EXPECT_EQ(broken.reached.size(), 1u);
  EXPECT_TRUE(Perform(*queue, dance).summary);
}

TEST(DanceStream, WarnsOfIntervalsTooShortForTheChange) {
  const auto queue = FakeQueue();
  Dance dance;
  Pose far = RestPose(Skeleton::Smpl24());
  dance.keys.push_back({"start", 0, far, {}});
  far.root_position.x() += 5;
  dance.keys.push_back({"far", 10, far, {}});
  far.rotations.col(17) = Eigen::Vector3d(0, 0, 3);
  dance.keys.push_back({"twist", 14, far, {}});
  const Recording recording = Perform(*queue, dance);
  ASSERT_TRUE(recording.summary);
  std::vector<Warning> asked, danced;
  for (const Warning& warning : recording.warnings)
    (warning.code == Warning::Code::kIntervalTooShort ? asked : danced).push_back(warning);
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_EQ(asked[0].frame, 10);
  EXPECT_THAT(asked[0].message, ::testing::HasSubstr("15 m/s"));
  EXPECT_NEAR(asked[0].figure, 15, 0.1);
  EXPECT_EQ(asked[0].limit, RequiredSpeed::kRootLimit);
  EXPECT_THAT(asked[1].message, ::testing::HasSubstr("rad/s"));
  // And of what was danced for them.
  ASSERT_EQ(danced.size(), 2u);
  for (const Warning& warning : danced) EXPECT_EQ(warning.code, Warning::Code::kJointTooFast);
  EXPECT_EQ(danced[0].key_id, "far");
  EXPECT_EQ(danced[1].key_id, "twist");
}

TEST(DanceStream, RefusedMessagesChangeNothing) {
  const auto queue = FakeQueue();
  const Dance dance = RandomDance(23, 3);
  const Recording expected = Perform(*queue, dance);
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(*queue, Checked(*queue, dance.config), sink);
  Pose bad = dance.keys[0].pose;
  bad.rotations(0, 16) = 7.9;
  const std::vector<float> nan(10, std::nanf(""));
  for (const Key& key : dance.keys) {
    EXPECT_THROW(stream.SetKey({.id = "bad", .pose = bad}, AtFrame{90'000}), Error);
    SendKey(stream, key);
    EXPECT_THROW(stream.SetKey({.id = "bad", .pose = key.pose}, AtFrame{key.frame}), Error);
    EXPECT_THROW(stream.RemoveKey("unknown"), Error);
    EXPECT_THROW(stream.GenerateUntil(-5), Error);
  }
  EXPECT_THROW(stream.EndOfAudio(), Error);
  EXPECT_THROW(stream.PushAudio(dance.samples, 1), Error);
  EXPECT_THROW(stream.PushAudio(nan, 0), Error);
  stream.PushAudio(dance.samples, 0);
  EXPECT_THROW(stream.PushAudio(dance.samples, 0), Error);
  stream.HalfClose();
  const Recording recording = sink->WaitForEnd();
  ASSERT_TRUE(recording.summary);
  EXPECT_TRUE(SameDance(expected, recording));
}

}  // namespace choreo::dance_stream_test
