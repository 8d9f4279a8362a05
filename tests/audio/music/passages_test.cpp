#include "model/audio/music/passages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/audio/beats/beats.h"
#include "model/audio/music/made_song.h"
#include "model/audio/music/music_analysis.h"
#include "model/audio/music/music_id.h"

/// Songs assembled from parts, so that repeats are known.
namespace choreo::passages_test {

constexpr double kPart = 24;  // seconds

std::vector<float> Part(uint64_t seed) {
  return MakeSong({.seed = seed, .seconds = kPart, .tempo = {{0, 120}}}).mono;
}

std::vector<float> SongOf(std::initializer_list<uint64_t> parts) {
  std::vector<float> song;
  for (const uint64_t seed : parts) {
    const std::vector<float> part = Part(seed);
    song.insert(song.end(), part.begin(), part.end());
  }
  return song;
}

// Seconds in [from, to) found to repeat what was about `lag` seconds before.
double Found(const std::vector<Passage>& passages, double lag, double from, double to,
             double tolerance = 0.3) {
  double found = 0;
  for (const Passage& passage : passages) {
    if (std::abs(passage.from - passage.like - lag) < tolerance)
      found += std::max(0.0, std::min(passage.to, to) - std::max(passage.from, from));
  }
  return found;
}

TEST(Passages, FindsAReturningPart) {
  const std::vector<Passage> passages = FindPassages(SongOf({11, 12, 11, 13}), {});
  EXPECT_GT(Found(passages, 2 * kPart, 2 * kPart, 3 * kPart), 0.8 * kPart);
  EXPECT_EQ(Found(passages, 2 * kPart, 0, 2 * kPart), 0);
}

// Near a change beats have another phase than in the part that returns.
TEST(Passages, RepeatWhenTheirMusicDoes) {
  std::vector<double> beats;
  for (double beat = 0.1; beat < 2 * kPart; beat += 0.5) beats.push_back(beat);
  for (double beat = 2 * kPart - 0.3; beat < 4 * kPart; beat += 0.5) beats.push_back(beat);
  const std::vector<Passage> passages = FindPassages(SongOf({11, 12, 11, 13}), beats);
  EXPECT_GT(Found(passages, 2 * kPart, 2 * kPart, 3 * kPart, 0.01), 0.8 * kPart);
}

// The whole analysis finds beats unless it is given some, and passages at them.
TEST(Passages, AreFoundAtTheBeatsOfTheAnalysis) {
  const std::vector<float> song = SongOf({11, 12, 11});
  const MusicAnalysis found = AnalyseMusic(song);
  EXPECT_EQ(found.beats, FindBeats(song).Seconds());
  EXPECT_EQ(found.downbeats, FindBeats(song).DownbeatSeconds());
  EXPECT_EQ(found.passages, FindPassages(song, found.beats));
  EXPECT_EQ(found.id, MusicId(song));
  const std::vector<double> beats = {1, 1.7, 2.4, 3.1};
  const MusicAnalysis given = AnalyseMusic(song, beats);
  EXPECT_EQ(given.beats, beats);
  EXPECT_EQ(given.passages, FindPassages(song, beats));
}

TEST(Passages, FirstOriginStartsWithTheSong) {
  const std::vector<Passage> passages = FindPassages(SongOf({11, 12, 11, 12, 11}), {});
  ASSERT_GE(passages.size(), 2U);
  EXPECT_EQ(passages.front().like, 0) << "with the song, not a moment behind it";
}

TEST(Passages, AreSortedDisjointAndReferBackwards) {
  const std::vector<Passage> passages = FindPassages(SongOf({11, 12, 11, 12, 11}), {});
  double end = 0;
  for (const Passage& passage : passages) {
    EXPECT_GE(passage.from, end);
    EXPECT_GT(passage.to, passage.from);
    EXPECT_GE(passage.like, 0);
    EXPECT_LT(passage.like, passage.from);
    end = passage.to;
  }
  EXPECT_GE(passages.size(), 2U);
}

TEST(Passages, SilenceDoesNotComeBack) {
  EXPECT_TRUE(FindPassages(std::vector<float>(60 * kModelSampleRate), {}).empty());
  EXPECT_TRUE(FindPassages({}, {}).empty());
}

// Later music only changes the last seconds of passages.
TEST(Passages, AreFoundAtTheStartOfASong) {
  const std::vector<float> song = SongOf({11, 12, 11, 12});
  const auto cut = [&](double seconds) {
    return FindPassages(std::span(song).first(static_cast<size_t>(seconds * kModelSampleRate)), {});
  };
  const std::vector<Passage> whole = cut(4 * kPart), part = cut(2.8 * kPart);
  ASSERT_FALSE(part.empty());
  EXPECT_EQ(part.front().from, whole.front().from);
  EXPECT_EQ(part.front().like, whole.front().like);
}

// A moment's result depends only on the music before it.
TEST(Passages, AreDetectedLive) {
  const std::vector<float> song = SongOf({11, 12, 11});
  PassageListener listener;
  double returned = 0;
  for (size_t at = 0; at + PassageListener::kWindow <= song.size(); at += PassageListener::kHop) {
    listener.Add(std::span(song).subspan(at, PassageListener::kWindow));
    const std::optional<int64_t> lag = listener.Lag();
    const double lag_s = static_cast<double>(lag.value_or(0)) * PassageListener::kMomentSeconds;
    const bool is_third = at >= static_cast<size_t>(2 * kPart * kModelSampleRate);
    if (is_third && std::abs(lag_s - 2 * kPart) < 0.3) returned += PassageListener::kMomentSeconds;
  }
  EXPECT_GT(returned, 0.6 * kPart);
}

}  // namespace choreo::passages_test
