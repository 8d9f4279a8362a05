#include "model/dance/transition/dance_score.h"

#include <gtest/gtest.h>

#include <random>

#include "model/dance/transition/transition.h"
#include "tests/dance/dances.h"

// Which transition follows from a dance's messages, without queue, threads and sampler.
namespace choreo::dance_score_test {

ModelInfo Model() { return ControlledSampler().model(); }

Key KeyAt(const std::string& id, int64_t frame) {
  std::mt19937 random(static_cast<uint32_t>(frame));
  return {.id = id, .frame = frame, .pose = RandomPose(random)};
}

class DanceScoreTest : public ::testing::Test {
 protected:
  DanceScore Score(const DanceConfig& config, const AudioFeed* audio = nullptr) const {
    return {model, ValidDance(config, model), audio};
  }
  static void Set(DanceScore* score, const Key& key) {
    ASSERT_TRUE(score->SetKey(key, AtFrame{key.frame}).empty());
  }

  const ModelInfo model = Model();
};

TEST_F(DanceScoreTest, NothingFollowsBeforeItIsGranted) {
  DanceScore score = Score({});
  EXPECT_FALSE(score.TakeNext(0, 0));
  Set(&score, KeyAt("a", 40));
  const auto next = score.TakeNext(0, 0);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->segment.from, 0);
  EXPECT_EQ(next->segment.to, 41);
  EXPECT_EQ(next->segment.key->id, "a");
  EXPECT_FALSE(score.TakeNext(1, 0)) << "no key after it";
}

TEST_F(DanceScoreTest, NothingFollowsTheEnd) {
  DanceScore score = Score({});
  Set(&score, KeyAt("a", 40));
  score.KeysComplete();
  EXPECT_FALSE(score.EndsBy(40));
  EXPECT_TRUE(score.EndsBy(41));
  ASSERT_TRUE(score.TakeNext(0, 0));
  EXPECT_FALSE(score.Overtakes(40));
  EXPECT_TRUE(score.Overtakes(41));
  EXPECT_FALSE(score.TakeNext(1, 0));
}

// Keys and turns of the music shift transitions; a repeat is danced like its original only if both
// are divided alike.
TEST_F(DanceScoreTest, UnknownMusicIsDividedAlikeEachTimeItSounds) {
  DanceConfig config;
  config.audio = DanceConfig::Audio{22050, 1, 0};
  AudioFeed feed(22050, 1, 0);
  feed.Push(std::vector<float>(size_t{22050} * 30), 0, [] {});
  DanceScore score = Score(config, &feed);
  Set(&score, KeyAt("a", 99));
  score.GivePassages({{10.5, 20, 2}});
  score.GenerateUntil(640);
  std::vector<int64_t> ends;
  while (const auto next = score.TakeNext(0, feed.ready())) {
    ends.push_back(next->segment.to);
    score.Finish();
  }
  constexpr int64_t kLag = 255;
  EXPECT_EQ(ends, (std::vector<int64_t>{100, 180, 240, 300, 120 + kLag, 180 + kLag, 240 + kLag,
                                        300 + kLag, 600, 660}));
}

TEST_F(DanceScoreTest, ATransitionWaitsForItsMusic) {
  DanceConfig config;
  config.audio = DanceConfig::Audio{22050, 1, 0};
  AudioFeed feed(22050, 1, 0);
  DanceScore score = Score(config, &feed);
  Set(&score, KeyAt("a", 40));
  EXPECT_FALSE(score.TakeNext(0, 0));
  feed.Push(Song(22050, 3), 0, [] {});
  ASSERT_GT(feed.ready(), 0);
  EXPECT_TRUE(score.TakeNext(0, feed.ready()));
}

TEST_F(DanceScoreTest, ATransitionHasTheEnergyOfItsOwnMusicWhereThatIsKnown) {
  DanceConfig config;
  config.audio = DanceConfig::Audio{22050, 1, 0};
  config.music_dynamics = 0.5;
  config.music_energies = std::vector<float>(4, -1);
  config.music_energies.resize(8, 1);  // from second 2 on
  AudioFeed feed(22050, 1, 0);
  feed.Push(Song(22050, 3), 0, [] {});
  DanceScore score = Score(config, &feed);
  Set(&score, KeyAt("a", 59));
  Set(&score, KeyAt("b", 119));
  const auto energy = [&](size_t nth) {
    const auto next = score.TakeNext(nth, feed.ready());
    return next->music.Hear().energy;
  };
  EXPECT_EQ(energy(0).now, -0.5);
  EXPECT_EQ(energy(1).before, -0.5);
  EXPECT_EQ(energy(1).now, 0.5);
}

// A change ahead ends the transition under way where it is granted.
TEST_F(DanceScoreTest, AMessageOvertakesATransition) {
  DanceScore score = Score({});
  score.GenerateUntil(20);
  const auto first = score.TakeNext(0, 0);
  ASSERT_TRUE(first);
  const int64_t planned = first->segment.to;
  EXPECT_FALSE(score.Overtakes(20));
  Set(&score, KeyAt("a", 30));
  score.GenerateUntil(31);
  ASSERT_TRUE(score.TakeNext(1, 0));
  EXPECT_LT(20, planned);
  EXPECT_TRUE(score.Overtakes(20));
}

// Workers prepare transitions while messages arrive.
TEST_F(DanceScoreTest, LaterMessagesChangeNothingOfATransition) {
  DanceConfig config;
  config.audio = DanceConfig::Audio{22050, 1, 0};
  AudioFeed feed(22050, 1, 0);
  feed.Push(Song(22050, 20), 0, [] {});
  DanceScore score = Score(config, &feed);
  Set(&score, KeyAt("a", 300));
  Set(&score, KeyAt("b", 400));
  ASSERT_TRUE(score.TakeNext(0, feed.ready()));
  const auto next = score.TakeNext(1, feed.ready());
  ASSERT_TRUE(next);
  TransitionInputs inputs{
      .controls = score.controls(), .segment = next->segment, .music = next->music};
  inputs.spec.noise_like = next->noise_like;
  const auto prepare = [&] { return PrepareTransition(model, inputs).run.spec(); };
  const TransitionSpec before = prepare();
  score.GiveBeats({14.1, 14.7, 15.3}, {}, {});
  ControlRequest controls;
  controls.root_path = ControlRequest::RootPath{{401, 500}, {{0, 0}, {1, 1}}, {}};
  score.SetControls(controls);
  score.GivePassages({{14, 16, 2}});
  score.SetMusic({.beats = {1, 2, 3}, .id = 5});
  const TransitionSpec after = prepare();
  EXPECT_FALSE(before.beats.empty());
  EXPECT_EQ(before.beats, after.beats);
  EXPECT_EQ(before.seed, after.seed);
  EXPECT_EQ(before.noise_like, after.noise_like);
  EXPECT_FALSE(after.controls[kRootPath].IsGiven());
}

TEST_F(DanceScoreTest, AKeyReachedBeforeTheResumeIsReportedAgainOnce) {
  DanceConfig config;
  config.continuation = Continuation{.frame = 50,
                                     .poses = FillHistory(model, {}),
                                     .fingerprint = model.fingerprint,
                                     .reached = {{.id = "a", .frame = 40, .raw_error_m = 0.5}}};
  DanceScore score = Score(config);
  const Key key = KeyAt("a", 40);
  const DanceEvents again = score.SetKey(key, AtFrame{40});
  ASSERT_EQ(again.size(), 1U);
  ASSERT_TRUE(std::holds_alternative<KeyReached>(again[0]));
  EXPECT_EQ(std::get<KeyReached>(again[0]).raw_error_m, 0.5);
  const DanceEvents late = score.SetKey(key, AtFrame{40});
  ASSERT_EQ(late.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<KeyRejected>(late[0]));
}

}  // namespace choreo::dance_score_test
