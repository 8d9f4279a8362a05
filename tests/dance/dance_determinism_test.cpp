#include "model/dance/dance_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "tests/dance/dances.h"

namespace choreo::dance_determinism_test {

TEST(DanceStream, SameSeedGivesSameBitsBesideOtherDances) {
  const auto alone = FakeQueue();
  Dance dance = RandomDance(13, /*music_seconds=*/4);
  const Recording expected = Perform(*alone, dance);
  ASSERT_TRUE(expected.summary);
  const auto crowded = FakeQueue(2);
  std::vector<std::thread> threads;
  std::vector<Recording> recordings(16);
  for (size_t i = 0; i < recordings.size(); ++i) {
    threads.emplace_back([&, i] {
      Dance mine = i % 2 == 0 ? dance : RandomDance(100 + static_cast<uint32_t>(i), 3);
      mine.chunk = 500 + 777 * static_cast<int64_t>(i);
      recordings[i] = Perform(*crowded, mine);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (size_t i = 0; i < recordings.size(); ++i) {
    ASSERT_TRUE(recordings[i].summary);
    EXPECT_EQ(SameDance(expected, recordings[i]), i % 2 == 0) << i;
  }
  dance.config.seed ^= 1;
  EXPECT_FALSE(SameDance(expected, Perform(*alone, dance)));
}

TEST(DanceStream, ChunksAndInterleavingOfAudioDoNotMatter) {
  const auto queue = FakeQueue();
  const Dance dance = RandomDance(14, 4);
  const Recording expected = Perform(*queue, dance);
  ASSERT_TRUE(expected.summary);
  std::mt19937 random(5);
  for (int round = 0; round < 12; ++round) {
    auto sink = std::make_shared<Recorder>();
    DanceStream stream(*queue, Checked(*queue, dance.config), sink);
    size_t key = 0;
    int64_t sample = 0;
    const int64_t samples = static_cast<int64_t>(dance.samples.size());
    bool complete = false, ended = false;
    while (!complete || !ended) {
      if (random() % 2 == 0 && !complete) {
        if (key < dance.keys.size()) {
          SendKey(stream, dance.keys[key++]);
        } else {
          stream.KeysComplete();
          complete = true;
        }
      } else if (!ended) {
        const int64_t count = std::min<int64_t>(samples - sample, random() % 20000);
        if (sample == samples) {
          stream.EndOfAudio();
          ended = true;
        } else {
          stream.PushAudio(std::span(dance.samples)
                               .subspan(static_cast<size_t>(sample), static_cast<size_t>(count)),
                           sample);
          sample += count;
        }
      }
    }
    const Recording recording = sink->WaitForEnd();
    ASSERT_TRUE(recording.summary);
    EXPECT_TRUE(SameDance(expected, recording)) << round;
  }
}

TEST(DanceStream, OrderOfKeysDoesNotMatterAfterTheFrontier) {
  const auto queue = FakeQueue();
  Dance dance = RandomDance(15);
  const Recording expected = Perform(*queue, dance);
  std::mt19937 random(6);
  for (int round = 0; round < 10; ++round) {
    std::vector<Key> shuffled = dance.keys;
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    auto sink = std::make_shared<Recorder>();
    DanceStream stream(*queue, Checked(*queue, dance.config), sink);
    stream.GenerateUntil(0);
    for (Key key : shuffled) {
      if (round % 2 == 0) {  // first somewhere else, with another pose, then moved
        Key wrong = key;
        wrong.frame += 50'000;
        wrong.pose = RandomPose(random);
        SendKey(stream, wrong);
      }
      SendKey(stream, key);
    }
    stream.SetKey({.id = "mistake", .pose = RandomPose(random)}, AtFrame{70'000});
    stream.RemoveKey("mistake");
    stream.KeysComplete();
    const Recording recording = sink->WaitForEnd();
    ASSERT_TRUE(recording.summary);
    EXPECT_TRUE(SameDance(expected, recording));
  }
}

TEST(DanceStream, OrderOfMusicEndAndKeysEndDoesNotMatter) {
  const auto queue = FakeQueue();
  Dance dance = RandomDance(16, 3.3);
  dance.keys.resize(1);
  const Recording expected = Perform(*queue, dance);
  ASSERT_TRUE(expected.summary);
  EXPECT_EQ(expected.poses.size(), 99u);
  for (int order = 0; order < 3; ++order) {
    auto sink = std::make_shared<Recorder>();
    DanceStream stream(*queue, Checked(*queue, dance.config), sink);
    if (order == 0) {
      // Far more is granted than there is music; whether the dance continues after it is unknown
      // until the keys are complete.
      SendKey(stream, dance.keys[0]);
      stream.GenerateUntil(1000);
      stream.PushAudio(dance.samples, 0);
      stream.EndOfAudio();
      EXPECT_EQ(sink->WaitForFrames(99).poses.size(), 99u);
      stream.KeysComplete();
    } else {
      stream.PushAudio(dance.samples, 0);
      SendKey(stream, dance.keys[0]);
      if (order == 1) stream.KeysComplete();
      stream.EndOfAudio();
      if (order == 2) stream.KeysComplete();
    }
    const Recording recording = sink->WaitForEnd();
    ASSERT_TRUE(recording.summary);
    EXPECT_TRUE(SameDance(expected, recording));
  }
}

TEST(DanceStream, PausingHoldsFramesBackAndChangesNone) {
  const auto queue = FakeQueue();
  const Dance dance = RandomDance(18);
  const Recording expected = Perform(*queue, dance);
  auto sink = std::make_shared<Recorder>();
  std::atomic<DanceStream*> handle = nullptr;
  sink->on_frames = [&handle](size_t count) {
    if (count % 10 == 0) handle.load()->SetPaused(true);
  };
  DanceStream stream(*queue, Checked(*queue, dance.config), sink);
  handle = &stream;
  for (const Key& key : dance.keys) SendKey(stream, key);
  stream.KeysComplete();
  for (size_t count = 10; count < expected.poses.size(); count += 10) {
    EXPECT_EQ(sink->WaitForFrames(count).poses.size(), count);
    stream.SetPaused(false);
  }
  const Recording recording = sink->WaitForEnd();
  EXPECT_TRUE(SameDance(expected, recording));
}

TEST(DanceStream, MovingAndTurningTheSceneMovesTheDance) {
  const auto queue = FakeQueue();
  std::mt19937 random(8);
  Dance dance = RandomDance(22);
  dance.config.history = MotionTo(RandomPose(random), 10, random);
  const Recording here = Perform(*queue, dance);
  const double heading = 2.1;
  const Eigen::Vector3d shift(12, 0, -7);
  for (Pose& pose : dance.config.history) pose = Placed(pose, heading, shift);
  for (Key& key : dance.keys) key.pose = Placed(key.pose, heading, shift);
  const Recording there = Perform(*queue, dance);
  ASSERT_EQ(here.poses.size(), there.poses.size());
  for (size_t i = 0; i < here.poses.size(); ++i) {
    const PoseError error =
        ComparePoses(Skeleton::Smpl24(), there.poses[i], Placed(here.poses[i], heading, shift));
    // Rounding to float 12 m away moves a nearly straight knee by a millimetre or two.
    ASSERT_LT(error.position_m, 5e-3) << i;
  }
}

}  // namespace choreo::dance_determinism_test
