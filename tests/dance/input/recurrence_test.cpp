#include "model/dance/input/recurrence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/dance/dances.h"
#include "tests/support/expect_error.h"

/// Music that repeats, and a dance that repeats with it.
namespace choreo::recurrence_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Recurrence, OriginIsTheFirstOccurrence) {
  const std::vector<Passage> passages{{10, 20, 0}, {30, 40, 12}};
  const Recurrence recurrence(30, passages);
  EXPECT_EQ(recurrence.Origin(299), 299);
  EXPECT_EQ(recurrence.Origin(300), 0);
  EXPECT_EQ(recurrence.Origin(599), 299);
  EXPECT_EQ(recurrence.Origin(600), 600);
  EXPECT_EQ(recurrence.Origin(900), 60) << "12 s, which was 2 s";
  EXPECT_THAT(recurrence.Origins(100, 200), IsEmpty());
  EXPECT_THAT(recurrence.Origins(298, 302), ElementsAre(298, 299, 0, 1));
}

TEST(Recurrence, LoopRefersToItsFirstRound) {
  const std::vector<Passage> passages{{2, 12, 0}};
  const Recurrence recurrence(30, passages);
  EXPECT_EQ(recurrence.Origin(60), 0);
  EXPECT_EQ(recurrence.Origin(60 * 5 + 7), 7);
}

TEST(Recurrence, LaterPassagesApplyAfterTheFrozenFrames) {
  const std::vector<Passage> first{{10, 20, 0}}, later{{12, 30, 4}};
  Recurrence recurrence(30, first);
  recurrence.Give(later, 450, "p");
  recurrence.StartTransition(420);
  EXPECT_EQ(recurrence.Origin(460), 160) << "of one that began before";
  recurrence.StartTransition(450);
  EXPECT_EQ(recurrence.Origin(450), 210);
  const std::vector<Passage> none{{20, 20, 0}};
  recurrence.Give(none, 470, "p");
  recurrence.StartTransition(480);
  EXPECT_EQ(recurrence.Origin(599), 59) << "359, which was 59";
  EXPECT_EQ(recurrence.Origin(600), 600) << "it ended there";
}

TEST(Recurrence, CutsOfARepeatLieWhereItsOriginalsLie) {
  const std::vector<Passage> passages{{20.1, 30, 0}};
  const Recurrence recurrence(30, passages);
  EXPECT_EQ(recurrence.NextCut(60), 60);
  EXPECT_EQ(recurrence.NextCut(61), 120);
  EXPECT_EQ(recurrence.NextCut(601), 603) << "where the repeat begins";
  EXPECT_EQ(recurrence.NextCut(604), 663);
  EXPECT_EQ(recurrence.NextCut(870), 900) << "where it ends";
}

// Thousands of short repeats may follow each other.
TEST(Recurrence, LooksForACutNoFartherThanTwoSeconds) {
  const std::vector<Passage> passages{{10, 11, 0.5}, {11, 12, 0.5}, {12, 13, 0.5}};
  const Recurrence recurrence(30, passages);
  EXPECT_EQ(recurrence.NextCut(300), std::nullopt);
  EXPECT_EQ(recurrence.NextCut(270), std::nullopt);
  EXPECT_EQ(recurrence.NextCut(360), 420);
}

TEST(Recurrence, TakesAsManyAsAStreamMayGive) {
  Recurrence recurrence(30, {});
  const std::vector<Passage> one{{10, 20, 0}};
  for (size_t i = 0; i < kMaxPassages; ++i) recurrence.Give(one, 0, "p");
  ExpectError(ErrorCode::kInvalidArgument, "p: 6001 passages in all, the limit is 6000",
              [&] { recurrence.Give(one, 0, "p"); });
}

TEST(Recurrence, CutsAreAtBoundsAndBetweenThemEveryTwoSeconds) {
  const std::vector<Passage> passages{{5, 9, 0}, {10, 13, 5}};
  EXPECT_THAT(CutsOf(passages, 30), ElementsAre(0, 60, 90, 120, 150, 210, 240, 270, 300, 360, 390))
      << "0 to 4 s, and 5 to 9, are cut at 3 s because 10 to 13 repeats that much";
}

// A turn of the music, or a key, in one of them shifts its transitions: it must come back.
TEST(Recurrence, ARepetitionHasItsOriginalsCuts) {
  const std::vector<Passage> passages{{20, 30, 0}, {40, 47, 3}, {50, 70, 20}};
  const std::vector<int64_t> cuts = CutsOf(passages, 30);
  for (const Passage& passage : passages) {
    const auto from = static_cast<int64_t>(passage.from * 30);
    const auto lag = static_cast<int64_t>((passage.from - passage.like) * 30);
    for (int64_t frame = from; frame < static_cast<int64_t>(passage.to * 30); ++frame) {
      if (!std::ranges::binary_search(cuts, frame - lag)) continue;
      EXPECT_TRUE(std::ranges::binary_search(cuts, frame)) << frame;
    }
  }
}

TEST(Recurrence, PassagesAreRefusedByNameValueAndLimit) {
  const auto refuses = [](const std::vector<Passage>& passages, const std::string& message) {
    ExpectError(ErrorCode::kInvalidArgument, message, [&] { CheckPassages(passages, "p"); });
  };
  refuses({{10, 9, 0}}, "p[0].to: 9 s is not in [10, 600]");
  refuses({{10, 12, 9}}, "p[0].like: 9 s is not in [0, 8]");
  refuses({{10, 12, 0}, {11, 14, 0}}, "p[1].from: 11 s is not in [12, 600]");
  refuses({{601, 700, 0}}, "p[0].from: 601 s is not in [2, 600]");
  refuses({{std::nan(""), 12, 0}}, "p[0].from: nan s");
}

// The music of seconds 0 to 6 comes back at 8: noise decides what this dancer does.
Recording DanceTo(std::vector<Passage> passages, double variation, const std::vector<Key>& keys) {
  const auto queue = QueueOf<FakeSampler>();
  Dance dance = RandomDance(3, 16);
  dance.keys = keys;
  dance.config.temperature = 1;
  dance.config.end_frame = 420;
  dance.config.music_passages = std::move(passages);
  dance.config.variation = variation;
  return Perform(*queue, dance);
}

double Apart(const Recording& dance, size_t a, size_t b) {
  double sum = 0;
  for (size_t i = 1; i < 120; ++i) {  // of steps: places differ
    const auto step = [&](size_t at) -> Eigen::Matrix3Xd {
      return dance.poses[at + i].rotations - dance.poses[at + i - 1].rotations;
    };
    sum += (step(a) - step(b)).norm();
  }
  return sum;
}

TEST(RecurringDance, RepeatsMoreWithLessVariation) {
  const std::vector<Passage> passages{{8, 14, 0}};
  const Recording apart = DanceTo({}, 0, {});
  ASSERT_TRUE(apart.summary) << apart.error->what();
  const double usual = Apart(apart, 60, 300);
  const double same = Apart(DanceTo(passages, 0, {}), 60, 300);  // but for what went before
  EXPECT_LT(same, 0.4 * usual);
  const double varied = Apart(DanceTo(passages, 0.5, {}), 60, 300);
  EXPECT_GT(varied, 1.5 * same);
  EXPECT_LT(varied, 0.9 * usual);
  EXPECT_TRUE(SameDance(DanceTo(passages, 1, {}), DanceTo(passages, 1, {})));
}

TEST(RecurringDance, FullVariationEqualsTheUsualDance) {
  EXPECT_TRUE(SameDance(DanceTo({{8, 14, 0}}, 1, {}), DanceTo({}, 1, {})));
}

// Whether a transition was sampled before they came or not: those under way keep what they had.
TEST(RecurringDance, DoesNotDependOnWhenItIsSampled) {
  const std::vector<Passage> passages{{2.4, 6, 0}};
  const auto dance = [&](bool patient) {
    const auto queue = QueueOf<FakeSampler>();
    Dance asked = RandomDance(3);
    asked.config.temperature = 1;
    asked.config.end_frame = 240;
    asked.config.generate_until = 0;
    asked.config.variation = 0;
    auto sink = std::make_shared<Recorder>();
    DanceStream stream(*queue, Checked(*queue, asked.config), sink);
    stream.GenerateUntil(70);
    if (patient) sink->WaitForFrames(70);
    stream.GivePassages(passages);
    stream.GenerateUntil(240);
    stream.HalfClose();
    return sink->WaitForEnd();
  };
  const Recording patient = dance(true);
  ASSERT_TRUE(patient.summary) << patient.error->what();
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(SameDance(dance(false), patient));
}

TEST(RecurringDance, HitsItsKeysAllTheSame) {
  std::mt19937 random(1);
  const std::vector<Key> keys{{"a", 290, RandomPose(random), {}}};
  const Recording dance = DanceTo({{8, 14, 0}}, 0, keys);
  ASSERT_TRUE(dance.summary) << dance.error->what();
  ASSERT_EQ(dance.reached.size(), 1U);
  EXPECT_LT(dance.reached[0].final_error_m, 1e-3);
}

}  // namespace choreo::recurrence_test
