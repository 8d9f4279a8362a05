#include "model/audio/beats/suggest_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "model/audio/beats/onset.h"
#include "tests/audio/signals.h"
#include "tests/support/expect_error.h"

namespace choreo::suggest_keys_test {

constexpr int64_t kPeriod = 46;  // onset frames: 0.51 s, 117 a minute

/// A beat every kPeriod onset frames; every `bar`-th is strong, the others half as strong.
struct Song {
  Song(int64_t beats, int64_t bar) : envelope(static_cast<size_t>((beats + 1) * kPeriod), 0.0f) {
    track.tempo_bpm = 117;
    for (int64_t beat = 0; beat < beats; ++beat) {
      track.frames.push_back(10 + beat * kPeriod);
      envelope[static_cast<size_t>(track.frames.back())] = beat % bar == 0 ? 4.0f : 2.0f;
    }
  }
  std::vector<SuggestedKey> Suggest(int64_t count) const {
    return SuggestKeys(track, envelope, passages, {.count = count, .named = "n"});
  }
  /// Counts the beats from `first` on in bars.
  void Count(int64_t first, int bar) {
    track.beats_in_bar = bar;
    for (int64_t beat = 0; beat < std::ssize(track.frames); ++beat)
      track.in_bar.push_back(static_cast<int>(((beat - first) % bar + bar) % bar));
  }
  BeatTrack track;
  std::vector<float> envelope;
  std::vector<Passage> passages;
};

std::vector<size_t> BeatsOf(const std::vector<SuggestedKey>& keys) {
  std::vector<size_t> beats;
  for (const SuggestedKey& key : keys) beats.push_back(key.beat);
  return beats;
}

TEST(SuggestKeysTest, GivesTheRequestedNumberOnSeparateBeats) {
  const Song song(120, 4);
  const std::vector<double> times = song.track.Seconds();
  for (const int64_t count : {1, 2, 3, 7, 16, 29, 40}) {
    const std::vector<SuggestedKey> keys = song.Suggest(count);
    ASSERT_EQ(static_cast<int64_t>(keys.size()), count);
    for (size_t i = 0; i < keys.size(); ++i) {
      EXPECT_EQ(keys[i].time_s, times.at(keys[i].beat));
      EXPECT_EQ(keys[i].strength, keys[i].beat % 4 == 0 ? 1.0 : 0.5);
      if (i > 0) {
        EXPECT_GE(keys[i].time_s - keys[i - 1].time_s, kMinKeyInterval);
      }
    }
  }
}

TEST(SuggestKeysTest, AreSpreadOverTheSongOnItsStrongBeats) {
  for (const int64_t count : {3, 5, 8, 15}) {
    const Song song(120, 4);
    const double even = 119.0 / static_cast<double>(count);  // beats
    const std::vector<SuggestedKey> keys = song.Suggest(count);
    EXPECT_LT(static_cast<double>(keys.front().beat), even);
    EXPECT_GT(static_cast<double>(keys.back().beat), 119 - even);
    for (size_t i = 0; i < keys.size(); ++i) {
      EXPECT_EQ(keys[i].beat % 4, 0U) << count;
      if (i > 0) {
        EXPECT_NEAR(static_cast<double>(keys[i].beat - keys[i - 1].beat), even, 4.0) << count;
      }
    }
  }
}

// She would have to jump to it.
TEST(SuggestKeysTest, NoneStandsInTheFirstSecond) {
  for (const int64_t bar : {1, 3, 4}) {
    const Song song(120, bar);
    for (const int64_t count : {24, 30, 40}) EXPECT_GE(song.Suggest(count).front().time_s, 1);
  }
  // Two beats are heard, at 0.1 and 0.6 s.
  ExpectError(ErrorCode::kInvalidArgument, "no beat", [] { Song(2, 1).Suggest(1); });
}

TEST(SuggestKeysTest, EvenBeatsGiveEvenKeys) {
  // All beats alike: the only difference is the spread. 41 beats span 40, 5 keys: 4, 12, 20, ...
  EXPECT_EQ(BeatsOf(Song(41, 1).Suggest(5)), (std::vector<size_t>{4, 12, 20, 28, 36}));
}

/// The best of all choices of `count` beats that keep the interval, scored as in the header.
double BestByTryingAll(const Song& song, size_t first, int64_t left, double last, double even,
                       std::vector<size_t>* chosen, std::vector<size_t>* best, double score,
                       double top) {
  const std::vector<double> times = song.track.Seconds();
  const auto off = [](double ratio) { return (ratio - 1) * (ratio - 1); };
  if (left == 0) {
    score -= off((times.back() - last) / (even / 2));
    if (score > top + 1e-12) *best = *chosen;
    return std::max(score, top);
  }
  for (size_t i = first; i < times.size(); ++i) {
    if (times[i] < kFirstKey || (!chosen->empty() && times[i] - last < kMinKeyInterval)) continue;
    const double cost =
        chosen->empty() ? off((times[i] - times[0]) / (even / 2)) : off((times[i] - last) / even);
    const double strength = song.envelope[static_cast<size_t>(song.track.frames[i])] / 4.0;
    chosen->push_back(i);
    top = BestByTryingAll(song, i + 1, left - 1, times[i], even, chosen, best,
                          score + strength - cost, top);
    chosen->pop_back();
  }
  return top;
}

TEST(SuggestKeysTest, StandWherePhrasesBegin) {
  Song song(64, 1);
  song.Count(2, 4);  // eights at 2, 10, ... 58
  EXPECT_EQ(BeatsOf(song.Suggest(8)), (std::vector<size_t>{2, 10, 18, 26, 34, 42, 50, 58}));
  for (const SuggestedKey& key : song.Suggest(15)) EXPECT_GE(key.begins, Phrase::kBar) << key.beat;
  // The passage that began at 6 returns at 24, where no tracked bar begins.
  const std::vector<double> times = song.track.Seconds();
  song.passages = {{.from = times[24] + 0.1, .to = times[34], .like = times[6] - 0.1}};
  EXPECT_THAT(BeatsOf(song.Suggest(8)), testing::IsSupersetOf({6, 24}));
  const std::vector<Phrase> phrases = FindPhrases(song.track, song.passages);
  EXPECT_EQ(phrases[2], Phrase::kEight);
  EXPECT_EQ(phrases[6], Phrase::kPassage);
  EXPECT_EQ(phrases[10], Phrase::kBar);  // counting restarts
  EXPECT_EQ(phrases[11], Phrase::kBeat);
  EXPECT_EQ(phrases[14], Phrase::kEight);
  for (size_t i = 24; i < 34; ++i) EXPECT_EQ(phrases[i], phrases[i - 18]) << i;
  EXPECT_EQ(phrases[38], Phrase::kEight);  // as if nothing had returned
}

TEST(SuggestKeysTest, EightsRestartAfterAShortBar) {
  Song song(24, 1);
  song.Count(0, 3);  // two bars
  for (size_t i = 10; i < 24; ++i) song.track.in_bar[i] = static_cast<int>(i + 2) % 3;
  const std::vector<Phrase> phrases = FindPhrases(song.track, {});
  std::vector<size_t> eights;
  for (size_t i = 0; i < phrases.size(); ++i) {
    if (phrases[i] == Phrase::kEight) eights.push_back(i);
  }
  EXPECT_EQ(eights, (std::vector<size_t>{0, 6, 10, 16, 22}));
}

TEST(SuggestKeysTest, APartHasTheBeatsOfTheSong) {
  Song song(64, 1);
  song.Count(2, 4);
  const std::vector<double> times = song.track.Seconds();
  const std::vector<SuggestedKey> keys = SuggestKeys(
      song.track, song.envelope, {}, {.count = 2, .from_s = times[11], .until_s = times[30]});
  EXPECT_EQ(BeatsOf(keys), (std::vector<size_t>{18, 26}));
  EXPECT_EQ(keys[1].time_s, times[26]);
}

TEST(SuggestKeysTest, NoOtherChoiceIsBetter) {
  for (uint64_t seed = 0; seed < 12; ++seed) {
    Song song(15, 1);
    const std::vector<float> noise = Noise(15, seed);
    for (size_t i = 0; i < 15; ++i) {
      const float strength = i == 7 ? 4.0f : 2.0f + 1.9f * noise[i];
      song.envelope[static_cast<size_t>(song.track.frames[i])] = strength;
    }
    const std::vector<double> times = song.track.Seconds();
    const auto count = static_cast<int64_t>(2 + seed % 4);
    std::vector<size_t> chosen, best;
    BestByTryingAll(song, 0, count, 0, (times.back() - times.front()) / static_cast<double>(count),
                    &chosen, &best, 0, -1e9);
    EXPECT_EQ(BeatsOf(song.Suggest(count)), best) << seed;
  }
}

TEST(SuggestKeysTest, ClickTrackIsDividedAtItsBeats) {
  const std::vector<float> song = Clicks(30 * 22050, 7000, kPeriod * kOnsetHop);
  const std::vector<Onset> onsets = FindOnsets(song);
  const std::vector<float> envelope = OnsetStrength(onsets);
  const BeatTrack track = TrackBeats(onsets);
  const auto suggest = [&] { return SuggestKeys(track, envelope, {}, {.count = 6}); };
  const std::vector<SuggestedKey> keys = suggest();
  const std::vector<double> beats = track.Seconds();
  for (const SuggestedKey& key : keys) {
    EXPECT_EQ(key.time_s, beats.at(key.beat));
    EXPECT_GT(key.strength, 0);
    EXPECT_LE(key.strength, 1);
  }
  EXPECT_EQ(BeatsOf(keys), BeatsOf(suggest()));
}

TEST(SuggestKeysTest, MoreThanFitOrNoneAreRefused) {
  const Song song(20, 4);  // keys need three beats' room: 2, 5, ... 17
  EXPECT_EQ(song.Suggest(6).size(), 6U);
  const auto refused = [&](int64_t count, const std::string& part) {
    ExpectError(ErrorCode::kInvalidArgument, part, [&] { song.Suggest(count); });
  };
  refused(8, "n: 8 keys, must be 1 to 6: 20 beats, keys 1.2 s apart");
  refused(0, "n: 0 keys, must be 1 to 6");
  refused(-3, "n: -3 keys, must be 1 to 6");
  ExpectError(ErrorCode::kInvalidArgument, "n: 2 keys, but no beat is heard",
              [] { SuggestKeys(BeatTrack{}, {}, {}, {.count = 2, .named = "n"}); });
  EXPECT_EQ(BeatsOf(Song(3, 1).Suggest(1)), std::vector<size_t>{2});
  // Finds every choice that fits, even the only one.
  EXPECT_EQ(BeatsOf(Song(18, 4).Suggest(6)), (std::vector<size_t>{2, 5, 8, 11, 14, 17}));
}

}  // namespace choreo::suggest_keys_test
