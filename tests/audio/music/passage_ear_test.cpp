#include "model/audio/music/passage_ear.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/audio/music/made_song.h"

/// Live music, a part of which returns.
namespace choreo::passage_ear_test {

constexpr double kPart = 20;  // seconds

std::vector<float> SongOf(std::initializer_list<uint64_t> parts) {
  std::vector<float> song;
  for (const uint64_t seed : parts) {
    const std::vector<float> part = MakeSong({.seed = seed, .seconds = kPart}).mono;
    song.insert(song.end(), part.begin(), part.end());
  }
  return song;
}

std::vector<Passage> Hear(const std::vector<float>& song) {
  PassageEar ear;
  std::vector<Passage> told;
  constexpr size_t kPiece = 437;  // 20 ms, of whatever length
  for (size_t at = 0; at < song.size(); at += kPiece) {
    const auto passage = ear.Hear(std::span(song).subspan(at, std::min(kPiece, song.size() - at)));
    if (passage) told.push_back(*passage);
  }
  return told;
}

TEST(PassageEar, PredictsRepeatedMusic) {
  const std::vector<Passage> told = Hear(SongOf({21, 22, 21}));
  ASSERT_FALSE(told.empty());
  size_t as_before = 0;
  for (const Passage& passage : told) {
    EXPECT_LT(passage.like, passage.from);
    EXPECT_GE(passage.to, passage.from);
    as_before += std::abs(passage.from - passage.like - 2 * kPart) < 0.02;
  }
  EXPECT_GE(as_before, 10U) << "once a second, but for the first";
  EXPECT_GT(told.back().from, 2.8 * kPart);
}

TEST(PassageEar, EndsAWrongPrediction) {
  const std::vector<Passage> told = Hear(SongOf({21, 22, 21, 23}));
  double holds_to = 0;  // what was told of the last return
  for (const Passage& passage : told) {
    if (std::abs(passage.from - passage.like - 2 * kPart) < 0.3)
      holds_to = passage.to;
    else if (passage.from < holds_to)
      holds_to = passage.from;
  }
  EXPECT_LT(holds_to, 3.5 * kPart);
}

TEST(PassageEar, GivesNothingInSilence) {
  EXPECT_TRUE(Hear(std::vector<float>(40 * kModelSampleRate)).empty());
}

}  // namespace choreo::passage_ear_test
