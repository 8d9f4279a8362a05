#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "tests/dance/dances.h"

/// Frames are sent up to the grant, and later frames may still change.
namespace choreo::partial_grant_test {

using Step = std::function<void(DanceStream&)>;

class PartialGrantTest : public testing::Test {
 protected:
  /// A live dance whose keys may be edited.
  static Dance Editable(uint32_t seed) {
    Dance dance = LiveDance(seed, 12);
    dance.config.generate_until = 0;
    return dance;
  }

  /// Plays the steps to the dance's whole music; `patient`: each when all frames granted before it
  /// have come.
  Recording Play(const Dance& dance, const std::vector<std::pair<Step, int64_t>>& steps,
                 bool patient) {
    auto sink = std::make_shared<Recorder>();
    DanceStream stream(*queue_, Checked(*queue_, dance.config), sink);
    SendSong(stream, dance, dance.config.audio->first_sample);
    const int64_t first = dance.config.FirstFrame();
    for (const auto& [step, granted] : steps) {
      step(stream);
      if (granted > first && patient) {
        const auto due = static_cast<size_t>(granted - first);
        EXPECT_EQ(sink->WaitForFrames(due).poses.size(), due);
      }
    }
    stream.HalfClose();
    return sink->WaitForEnd();
  }

  static std::pair<Step, int64_t> Grant(int64_t frame) {
    return {[frame](DanceStream& stream) { stream.GenerateUntil(frame); }, frame};
  }
  static std::pair<Step, int64_t> SendKeyStep(const Key& key) {
    return {[key](DanceStream& stream) { SendKey(stream, key); }, 0};
  }

  const std::unique_ptr<SampleQueue> queue_ = QueueOf<FakeSampler>();
};

TEST_F(PartialGrantTest, GrantsOf1And7AndAllFramesGiveEqualBits) {
  const Dance dance = Editable(51);
  Recording expected;
  for (const int64_t stride : {360, 7, 1}) {
    std::vector<std::pair<Step, int64_t>> steps;
    for (const Key& key : dance.keys) steps.push_back(SendKeyStep(key));
    for (int64_t frame = std::min<int64_t>(stride, 350); frame <= 350; frame += stride)
      steps.push_back(Grant(frame));
    const Recording recording = Play(dance, steps, /*patient=*/stride != 7);
    ASSERT_TRUE(recording.summary);
    EXPECT_EQ(recording.reached.size(), dance.keys.size());
    if (stride == 360) expected = recording;
    EXPECT_TRUE(SameDance(expected, recording)) << stride;
    EXPECT_EQ(recording.beats.size(), expected.beats.size());
    EXPECT_EQ(recording.continuations.size(), expected.continuations.size());
  }
}

// Keys sent before the first grant freeze no frames beyond it.
TEST_F(PartialGrantTest, KeysFreezeNothing) {
  Dance dance = Editable(52);
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(*queue_, Checked(*queue_, dance.config), sink);
  SendSong(stream, dance);
  for (const Key& key : dance.keys) SendKey(stream, key);
  stream.GenerateUntil(5);
  EXPECT_EQ(sink->WaitForFrames(5).poses.size(), 5U);
  for (const Key& key : dance.keys) stream.SetKey(key, AtFrame{key.frame + 1});
  stream.HalfClose();
  const Recording recording = sink->WaitForEnd();
  ASSERT_TRUE(recording.summary);
  EXPECT_TRUE(recording.rejected.empty());
  ASSERT_EQ(recording.reached.size(), dance.keys.size());
  EXPECT_EQ(recording.reached[0].frame, dance.keys[0].frame + 1);
}

// Two dances; the second moves a key, removes one and adds another in the middle of the transition.
TEST_F(PartialGrantTest, EditAfterTheFrontierChangesOnlyLaterFrames) {
  Dance dance = Editable(53);
  std::mt19937 random(53);
  dance.keys = {{"a", 60, RandomPose(random), {}}, {"b", 150, RandomPose(random), {}}};
  const Key moved{"b", 120, RandomPose(random), {}};
  const std::vector<std::pair<Step, int64_t>> begin = {
      SendKeyStep(dance.keys[0]), SendKeyStep(dance.keys[1]), Grant(20), Grant(90)};
  std::vector<std::pair<Step, int64_t>> edited = begin;
  edited.push_back(SendKeyStep(moved));
  for (const int64_t frame : {91, 130}) edited.push_back(Grant(frame));
  const Recording plain = Play(dance, begin, true);
  const Recording changed = Play(dance, edited, true);
  ASSERT_TRUE(plain.summary);
  ASSERT_TRUE(changed.summary);
  for (size_t i = 0; i < 90; ++i) EXPECT_TRUE(SameBits(plain.poses[i], changed.poses[i])) << i;
  EXPECT_FALSE(SameBits(plain.poses[91], changed.poses[91]));
  ASSERT_EQ(changed.reached.size(), 2U);
  EXPECT_EQ(changed.reached[1].frame, 120);
  EXPECT_LT(changed.reached[1].final_error_m, 1e-3);
  EXPECT_EQ(changed.continuations[1].frame, 90) << "there it was cut";
  EXPECT_TRUE(SameDance(changed, Play(dance, edited, false))) << "whatever has been danced by then";
  // A key that is moved and moved back changes nothing.
  edited = begin;
  edited.push_back(SendKeyStep(moved));
  edited.push_back(SendKeyStep(dance.keys[1]));
  edited.push_back(Grant(100));
  EXPECT_TRUE(SameDance(plain, Play(dance, edited, true)));
}

// Newer hands are told, and cut no transition; those of a key that comes too late are not.
TEST_F(PartialGrantTest, HandsBelongToTheirKeyAndChangeNoFrame) {
  Dance dance = Editable(55);
  std::mt19937 random(55);
  const Pose pose = RandomPose(random);
  const auto key = [&pose](HandPose hands) {
    return SendKeyStep({.id = "a", .frame = 60, .pose = pose, .hands = hands});
  };
  const Recording plain = Play(dance, {key(HandPose::kOpen), Grant(20), Grant(61)}, true);
  const Recording changed = Play(
      dance,
      {key(HandPose::kOpen), Grant(20), key(HandPose::kFist), Grant(61), key(HandPose::kPoint)},
      true);
  EXPECT_TRUE(SameDance(plain, changed));
  EXPECT_EQ(plain.continuations.size(), changed.continuations.size());
  EXPECT_EQ(changed.rejected.size(), 1U);
  ASSERT_EQ(plain.reached.size(), 1U);
  ASSERT_EQ(changed.reached.size(), 1U);
  EXPECT_EQ(plain.reached[0].hands, HandPose::kOpen);
  EXPECT_EQ(changed.reached[0].hands, HandPose::kFist);
}

// From the end of each transition, and from each cut, to the same messages again.
TEST_F(PartialGrantTest, ResumesInsideAnInterval) {
  Dance dance = Editable(54);
  std::mt19937 random(54);
  std::vector<std::pair<Step, int64_t>> steps;
  int64_t granted = 0;
  for (int i = 0; i < 40; ++i) {
    const int64_t frame = granted + static_cast<int64_t>(random() % 90);
    const Key key{
        std::string(1, static_cast<char>('a' + random() % 9)), frame, RandomPose(random), {}};
    steps.emplace_back(
        [key](DanceStream& stream) {
          try {
            SendKey(stream, key);
          } catch (const Error&) {  // too near to another one
          }
        },
        0);
    steps.push_back(Grant(granted += static_cast<int64_t>(random() % 15)));
  }
  const Recording whole = Play(dance, steps, true);
  ASSERT_TRUE(whole.summary);
  EXPECT_GT(whole.continuations.size(), whole.reached.size() + 3) << "no transition was cut";
  EXPECT_FALSE(whole.rejected.empty());
  for (size_t i = 0; i + 1 < whole.continuations.size(); ++i) {
    Dance rest = dance;
    rest.config.continuation = whole.continuations[i];
    rest.config.audio->first_sample = *whole.continuations[i].audio_from_sample;
    const Recording resumed = Play(rest, steps, i % 2 == 0);
    ASSERT_TRUE(resumed.summary) << resumed.error->what();
    EXPECT_TRUE(SameDance(whole, resumed)) << "from " << whole.continuations[i].frame;
    EXPECT_EQ(resumed.continuations.size(), whole.continuations.size() - i - 1);
  }
}

TEST_F(PartialGrantTest, WithoutMusicTheDanceGoesAsFarAsGranted) {
  auto sink = std::make_shared<Recorder>();
  DanceConfig config;
  config.generate_until = 40;
  DanceStream stream(*queue_, Checked(*queue_, config), sink);
  EXPECT_EQ(sink->WaitForFrames(40).poses.size(), 40U);
  stream.KeysComplete();
  EXPECT_EQ(sink->WaitForEnd().poses.size(), 40U);
}

}  // namespace choreo::partial_grant_test
