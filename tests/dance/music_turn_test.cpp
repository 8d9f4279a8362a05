#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "model/audio/music/made_song.h"
#include "tests/dance/dances.h"

namespace choreo::music_turn_test {

constexpr int64_t kDrop = 200;  // frames; no transition without keys begins near

std::vector<float> Drums(double seconds) { return MakeSong({.seed = 7, .seconds = seconds}).mono; }

/// Silence, a drop, silence again, and a drop again.
Dance DropDance(uint32_t seed) {
  Dance dance = LiveDance(seed, 1);
  dance.keys.clear();
  const std::vector<float> drums = Drums(5);
  const std::vector<float> silence(static_cast<size_t>(kDrop) * 735);
  dance.samples = silence;
  for (const auto* part : {&drums, &silence, &drums})
    dance.samples.insert(dance.samples.end(), part->begin(), part->end());
  return dance;
}

std::vector<int64_t> EndsOf(const Recording& recording) {
  std::vector<int64_t> ends;
  for (const Continuation& continuation : recording.continuations)
    ends.push_back(continuation.frame);
  return ends;
}

/// The first end of a transition after a frame.
int64_t EndAfter(const Recording& recording, int64_t frame) {
  const std::vector<int64_t> ends = EndsOf(recording);
  return *std::ranges::upper_bound(ends, frame);
}

TEST(MusicTurn, ADropEndsTheTransition) {
  const auto queue = QueueOf<FakeSampler>();
  Dance dance = DropDance(1);
  const Recording recording = Perform(*queue, dance);
  ASSERT_TRUE(recording.summary);
  EXPECT_LT(EndAfter(recording, kDrop), kDrop + 30);
  EXPECT_LT(EndAfter(recording, 2 * kDrop + 150), 2 * kDrop + 180);
  std::vector<int64_t> ends = EndsOf(recording);
  ends.pop_back();  // the dance's end
  int64_t before = 0;
  for (const int64_t end : ends) {
    EXPECT_GE(end - before, MusicDynamicsOptions().turn_after);
    before = end;
  }
  dance.config.music_dynamics = 0;
  ends = EndsOf(Perform(*queue, dance));
  ends.pop_back();
  for (const int64_t end : ends) EXPECT_EQ(end % kTypicalFrames, 0);
}

TEST(MusicTurn, SteadyMusicEndsNone) {
  const auto queue = QueueOf<FakeSampler>();
  Dance dance = DropDance(2);
  dance.samples = Drums(40);
  std::vector<int64_t> ends = EndsOf(Perform(*queue, dance));
  ends.pop_back();
  size_t early = 0;
  int64_t before = 0;
  for (const int64_t end : ends) {
    early += end - before < kTypicalFrames;
    before = end;
  }
  EXPECT_EQ(early, 0U);
}

TEST(MusicTurn, DoesNotDependOnWhenMessagesCome) {
  const auto queue = QueueOf<FakeSampler>();
  std::mt19937 random(3);
  Dance dance = DropDance(3);
  for (const int64_t frame : {90, 230, 330, 480, 600})
    dance.keys.push_back({std::to_string(frame), frame, RandomPose(random), {}});
  dance.config.generate_until = 0;
  std::vector<int64_t> ends;
  Recording expected;
  for (int round = 0; round < 12; ++round) {
    auto sink = std::make_shared<Recorder>();
    DanceStream stream(*queue, Checked(*queue, dance.config), sink);
    // The same keys and grants in the same order, and the same music, merged in another way. Keys
    // come late enough to lie in transitions that were planned without them.
    size_t message = 0, at = 0;
    while (message < 2 * dance.keys.size() || at < dance.samples.size()) {
      const bool speaks = round == 0 || (round > 1 && random() % 2 == 0);
      if (message < 2 * dance.keys.size() && (speaks || at == dance.samples.size())) {
        const Key& key = dance.keys[message / 2];
        if (message++ % 2 == 0) {
          SendKey(stream, key);
        } else {
          stream.GenerateUntil(key.frame + 25);
        }
      } else if (at < dance.samples.size()) {
        const size_t count = std::min<size_t>(dance.samples.size() - at, 1 + random() % 40'000);
        stream.PushAudio(std::span(dance.samples).subspan(at, count), static_cast<int64_t>(at));
        at += count;
      }
    }
    stream.HalfClose();
    const Recording recording = sink->WaitForEnd();
    ASSERT_TRUE(recording.summary) << recording.error->what();
    if (round == 0) {
      expected = recording;
      ends = EndsOf(expected);
      EXPECT_EQ(expected.reached.size(), dance.keys.size());
      for (const KeyReached& key : expected.reached) EXPECT_LT(key.final_error_m, 1e-4) << key.id;
    }
    EXPECT_TRUE(SameDance(expected, recording)) << round;
    EXPECT_EQ(EndsOf(recording), ends) << round;
  }
}

TEST(MusicTurn, ResumesBitForBitAroundIt) {
  const auto queue = QueueOf<FakeSampler>();
  const Dance dance = DropDance(4);
  const Recording whole = Perform(*queue, dance);
  for (size_t place = 0; place + 1 < whole.continuations.size(); ++place) {
    Dance rest = dance;
    rest.config.continuation = whole.continuations[place];
    rest.config.audio->first_sample = *whole.continuations[place].audio_from_sample;
    const Recording resumed = Perform(*queue, rest);
    EXPECT_TRUE(SameDance(whole, resumed)) << "from " << whole.continuations[place].frame;
    EXPECT_EQ(resumed.continuations.size(), whole.continuations.size() - place - 1);
  }
}

TEST(MusicTurn, LeavesTheWayToANearKeyAlone) {
  const auto queue = QueueOf<FakeSampler>();
  Dance dance = DropDance(5);
  std::mt19937 random(5);
  const int64_t near = kDrop + 25;
  dance.keys = {{"near", near, RandomPose(random), {}}};
  const Recording recording = Perform(*queue, dance);
  EXPECT_EQ(EndAfter(recording, kDrop), near + 1);
  ASSERT_EQ(recording.reached.size(), 1U);
}

}  // namespace choreo::music_turn_test
