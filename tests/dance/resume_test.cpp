#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/dance/dances.h"

namespace choreo::resume_test {

/// What a client sends again after the server broke: the same config with the continuation, the
/// same messages.
Recording Resume(SampleQueue& queue, const Dance& dance, const Continuation& continuation,
                 const std::function<void(DanceStream&)>& messages) {
  DanceConfig config = dance.config;
  config.history.clear();
  config.continuation = continuation;
  int64_t from = 0;
  if (config.audio) {
    from = std::min(*continuation.audio_from_sample,
                    static_cast<int64_t>(dance.samples.size()) / config.audio->channels);
    config.audio->first_sample = from;
  }
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(queue, Checked(queue, config), sink);
  messages(stream);
  if (config.audio) SendSong(stream, dance, from);
  stream.HalfClose();
  return sink->WaitForEnd();
}

// Expects the beats of the whole dance but for the first `told`.
void ExpectSameBeats(const Recording& whole, const Recording& rest, size_t told) {
  ASSERT_EQ(rest.beats.size(), whole.beats.size() - told);
  for (size_t i = 0; i < rest.beats.size(); ++i) {
    const Beat& wanted = whole.beats[told + i];
    EXPECT_EQ(rest.beats[i].time_s, wanted.time_s);
    EXPECT_EQ(rest.beats[i].source, wanted.source);
    EXPECT_EQ(rest.beats[i].confidence, wanted.confidence);
  }
}

/// Keys in order of time, with their errors and hands.
auto Figures(const std::vector<KeyReached>& keys) {
  std::vector<
      std::tuple<int64_t, std::string, double, double, double, double, std::optional<HandPose>>>
      figures;
  for (const KeyReached& key : keys)
    figures.emplace_back(key.frame, key.id, key.raw_error_m, key.final_error_m, key.final_error_deg,
                         key.correction_m, key.hands);
  std::ranges::sort(figures);
  return figures;
}

void ExpectResumesEverywhere(SampleQueue& queue, const Dance& dance,
                             const std::function<void(DanceStream&)>& messages) {
  auto sink = std::make_shared<Recorder>();
  DanceStream stream(queue, Checked(queue, dance.config), sink);
  messages(stream);
  if (dance.config.audio) SendSong(stream, dance);
  stream.HalfClose();
  const Recording whole = sink->WaitForEnd();
  ASSERT_TRUE(whole.summary) << whole.error->what();
  ASSERT_GE(whole.continuations.size(), 3u);
  for (size_t place = 0; place < whole.continuations.size(); ++place) {
    const Continuation& continuation = whole.continuations[place];
    const Recording rest = Resume(queue, dance, continuation, messages);
    ASSERT_TRUE(rest.summary) << rest.error->what();
    // Keys that were reached before the resume are reported and counted again.
    EXPECT_EQ(Figures(rest.reached), Figures(whole.reached)) << "from frame " << continuation.frame;
    EXPECT_EQ(Figures(rest.summary->keys), Figures(whole.summary->keys));
    if (&continuation == &whole.continuations.back()) {
      EXPECT_TRUE(rest.poses.empty());  // nothing is left to dance
      continue;
    }
    EXPECT_TRUE(SameDance(whole, rest)) << "from frame " << continuation.frame;
    ExpectSameBeats(whole, rest, whole.beats_before[place]);
    EXPECT_EQ(rest.summary->frames, whole.summary->frames - continuation.frame);
    EXPECT_EQ(rest.continuations.back().frame, whole.continuations.back().frame);
    EXPECT_EQ(Figures(rest.continuations.back().reached),
              Figures(whole.continuations.back().reached));
    EXPECT_TRUE(SameBits(rest.continuations.back().poses.front(),
                         whole.continuations.back().poses.front()));
  }
}

TEST(Resume, GoesOnBitForBitWithKeysAndMusic) {
  const auto queue = FakeQueue();
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    Dance dance = RandomDance(seed, 5);
    if (seed == 2) {
      dance.config.audio = DanceConfig::Audio{48000, 2, 0};
      dance.samples = Song(48000, 5, 2, seed);
    }
    if (seed == 3) dance.config.output_fps = 60;
    if (seed == 4) dance.config.output_fps = 23.976;
    ExpectResumesEverywhere(*queue, dance, [&dance](DanceStream& stream) {
      for (const Key& key : dance.keys) SendKey(stream, key);
    });
  }
}

TEST(Resume, GoesOnBitForBitWithMusicAlone) {
  const auto queue = FakeQueue();
  Dance dance = RandomDance(5, 7.7);
  std::mt19937 random(5);
  dance.config.history = MotionTo(RandomPose(random), 4, random);  // fewer than tau
  ExpectResumesEverywhere(*queue, dance, [](DanceStream&) {});
}

TEST(Resume, GoesOnBitForBitWithoutMusic) {
  const auto queue = FakeQueue();
  const Dance dance = RandomDance(6);
  ExpectResumesEverywhere(*queue, dance, [&dance](DanceStream& stream) {
    for (const Key& key : dance.keys) SendKey(stream, key);
  });
}

// Keys were edited while the dance went on: the log of messages decides, not what the keys came to
// be in the end.
TEST(Resume, GoesOnBitForBitAfterEdits) {
  const auto queue = FakeQueue();
  const Dance dance = RandomDance(7, 12);
  std::mt19937 random(7);
  std::vector<Pose> poses;
  for (int i = 0; i < 5; ++i) poses.push_back(RandomPose(random));
  ExpectResumesEverywhere(*queue, dance, [&poses](DanceStream& stream) {
    stream.GenerateUntil(0);
    stream.SetKey({.id = "a", .pose = poses[0]}, AtFrame{250});
    stream.GenerateUntil(70);
    stream.SetKey({.id = "b", .pose = poses[1], .hands = HandPose::kFist}, AtFrame{100});
    stream.SetKey({.id = "c", .pose = poses[2]}, AtTime{4.9});
    stream.RemoveKey("c");
    stream.GenerateUntil(110);
    stream.SetKey({.id = "d", .pose = poses[3]}, AfterPrevious{60});
    stream.GenerateUntil(300);
    stream.SetKey({.id = "e", .pose = poses[4]}, AtFrame{330});
  });
}

// A server that is lost after the last frame of all hands on a dance that only wants its summary.
TEST(Resume, ContinuesAfterAKeyInTheVeryLastFrame) {
  const auto queue = FakeQueue();
  Dance dance = RandomDance(10);
  dance.config.continuation = Continuation{.frame = kMaxDanceFrames - 20,
                                           .poses = FillHistory(queue->model(), {}),
                                           .fingerprint = queue->model().fingerprint};
  dance.keys.erase(dance.keys.begin() + 1, dance.keys.end());
  dance.keys.front().frame = kMaxDanceFrames;
  const Recording whole = Perform(*queue, dance);
  ASSERT_TRUE(whole.summary) << whole.error->what();
  EXPECT_EQ(whole.poses.size(), 21U);
  ASSERT_EQ(whole.continuations.size(), 1U);
  EXPECT_EQ(whole.continuations.front().frame, kMaxDanceFrames + 1);
  const Recording rest =
      Resume(*queue, dance, whole.continuations.front(),
             [&dance](DanceStream& stream) { SendKey(stream, dance.keys.front()); });
  ASSERT_TRUE(rest.summary) << rest.error->what();
  EXPECT_TRUE(rest.poses.empty());
}

TEST(Resume, RefusesAnotherFingerprintUnlessAllowed) {
  const auto queue = FakeQueue();
  const Dance dance = RandomDance(8);
  const Recording whole = Perform(*queue, dance);
  Continuation foreign = whole.continuations[1];
  foreign.fingerprint = "other";
  const auto keys = [&dance](DanceStream& stream) {
    for (const Key& key : dance.keys) SendKey(stream, key);
  };
  try {
    Resume(*queue, dance, foreign, keys);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kFailedPrecondition);
    EXPECT_EQ(error.field(), "continuation.fingerprint");
  }
  Dance allowed = dance;
  allowed.config.allow_inexact_resume = true;
  const Recording rest = Resume(*queue, allowed, foreign, keys);
  ASSERT_TRUE(rest.summary);
  ASSERT_FALSE(rest.warnings.empty());
  EXPECT_EQ(rest.warnings[0].code, Warning::Code::kInexactResume);
  EXPECT_EQ(Figures(rest.reached), Figures(whole.reached));
}

// A program that resumes with other keys gets reports only of keys that the dance reached.
TEST(Resume, RejectsKeysThatWereNotReachedBefore) {
  const auto queue = FakeQueue();
  const Dance dance = RandomDance(8);
  const Recording whole = Perform(*queue, dance);
  const Key& first = dance.keys[0];
  const Recording rest = Resume(*queue, dance, whole.continuations[1], [&](DanceStream& stream) {
    SendKey(stream, first);
    SendKey(stream, first);
    stream.SetKey({.id = "new", .pose = first.pose, .mask = first.mask}, AtFrame{first.frame - 5});
    for (size_t i = 1; i < dance.keys.size(); ++i) SendKey(stream, dance.keys[i]);
  });
  ASSERT_TRUE(rest.summary) << rest.error->what();
  EXPECT_EQ(Figures(rest.reached), Figures(whole.reached));
  ASSERT_EQ(rest.rejected.size(), 2U);
  EXPECT_EQ(rest.rejected[0].id, first.id);
  EXPECT_EQ(rest.rejected[1].id, "new");
}

TEST(Resume, RefusesReachedKeysThatCannotBe) {
  const auto queue = FakeQueue();
  const Dance dance = RandomDance(8);
  const Recording whole = Perform(*queue, dance);
  const auto refused = [&](const std::function<void(std::vector<KeyReached>&)>& spoil) {
    DanceConfig config = dance.config;
    config.continuation = whole.continuations[1];
    spoil(config.continuation->reached);
    try {
      ValidDance(config, queue->model());
    } catch (const Error& error) {
      return error.field();
    }
    return std::string("accepted");
  };
  const std::string field = "continuation.reached";
  EXPECT_EQ(refused([](auto&) {}), "accepted");
  EXPECT_EQ(refused([](auto& keys) { keys.resize(kMaxKeys + 1); }), field);
  EXPECT_EQ(refused([](auto& keys) { keys[1].id = ""; }), field + "[1].id");
  EXPECT_EQ(refused([](auto& keys) { keys[1].frame = keys[0].frame; }), field + "[1].frame");
  EXPECT_EQ(refused([&](auto& keys) { keys[1].frame = whole.continuations[1].frame; }),
            field + "[1].frame");
  EXPECT_EQ(refused([](auto& keys) { keys[0].correction_m = std::nan(""); }), field + "[0]");
}

TEST(Resume, AudioMustBeginEarlyEnough) {
  const auto queue = FakeQueue();
  Dance dance = RandomDance(9, 5);
  dance.config.music_dynamics = 0;
  const Recording whole = Perform(*queue, dance);
  DanceConfig config = dance.config;
  config.continuation = whole.continuations.back();
  const int64_t latest = LatestFirstSample(config.continuation->frame, 22050, queue->model());
  EXPECT_EQ(*config.continuation->audio_from_sample, latest);
  EXPECT_GT(latest, 0);
  config.audio->first_sample = latest;
  EXPECT_NO_THROW(ValidDance(config, queue->model()));
  config.audio->first_sample = latest + 1;
  try {
    ValidDance(config, queue->model());
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kOutOfRange);
    EXPECT_THAT(error.what(), ::testing::HasSubstr(std::to_string(latest)));
  }
  // Beat detection needs more music.
  config.audio->first_sample = latest;
  config.continuation->audio_from_sample = latest - 1;
  EXPECT_THROW(ValidDance(config, queue->model()), Error);
}

}  // namespace choreo::resume_test
