#include "client/live/beat_ear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/audio/music/made_song.h"

/// Music that sounds now: its beats are known before they sound.
namespace choreo::live::beat_ear_test {

/// The beats predicted from `from` s on, each before it sounds. Later predictions replace earlier
/// ones, but all downbeats are kept.
std::vector<double> Told(const std::vector<float>& song, double from,
                         std::vector<double>* downbeats = nullptr, const LiveBeatHint& hint = {}) {
  BeatEar ear(hint);
  std::vector<double> told;
  constexpr size_t kPiece = 437;  // 20 ms, of whatever length
  for (size_t at = 0; at < song.size(); at += kPiece) {
    const double now = static_cast<double>(at + kPiece) / kModelSampleRate;
    const auto piece = std::span(song).subspan(at, std::min(kPiece, song.size() - at));
    const BeatsAhead ahead = ear.Hear(piece);
    if (downbeats != nullptr && now > from)
      downbeats->insert(downbeats->end(), ahead.downbeats.begin(), ahead.downbeats.end());
    for (const double beat : ahead.beats) {
      EXPECT_GT(beat, now - 0.1) << "it has sounded";
      EXPECT_LT(beat, now + BeatEar::kAheadSeconds + 0.1);
      while (!told.empty() && told.back() >= beat - 0.2) told.pop_back();
      told.push_back(beat);
    }
    ear.Wait();
  }
  const double end = static_cast<double>(song.size()) / kModelSampleRate;
  std::erase_if(told, [&](double beat) { return beat < from || beat > end - 0.5; });
  return told;
}

double ShareMet(const std::vector<double>& told, const std::vector<double>& beats) {
  const auto met = std::ranges::count_if(told, [&](double beat) {
    return std::ranges::any_of(beats,
                               [beat](double other) { return std::abs(other - beat) < 0.07; });
  });
  return static_cast<double>(met) / static_cast<double>(told.size());
}

// In some songs the half beats are found at first, so not every beat counts.
TEST(BeatEar, PredictsBeats) {
  int well = 0, counted = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    const double bpm = 80 + 10 * static_cast<double>(seed);
    const MadeSong song = MakeSong({.seed = seed, .seconds = 30, .tempo = {{0, bpm}}});
    std::vector<double> downbeats;
    const std::vector<double> told = Told(song.mono, 12, &downbeats);
    ASSERT_GT(told.size(), 15U) << bpm;
    well += ShareMet(told, song.beats) > 0.9;
    std::erase_if(downbeats, [](double beat) { return beat > 29.5; });
    counted += ShareMet(downbeats, song.downbeats) > 0.7;
  }
  EXPECT_GE(well, 4);
  EXPECT_GE(counted, 3);
}

TEST(BeatEar, TellsTheFirstBeatsAfterThreeSeconds) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    const MadeSong song = MakeSong({.seed = seed, .seconds = 8, .tempo = {{0, 160}}});
    EXPECT_LT(Told(song.mono, 0).front(), 4) << seed;
  }
}

TEST(BeatEar, FollowsTheHint) {
  const MadeSong song = MakeSong({.seed = 3, .seconds = 30, .tempo = {{0, 110}}});
  const auto told = [&](const BeatHint& hint) { return Told(song.mono, 12, nullptr, {hint}); };
  const std::vector<double> all = told({.tempo_bpm = 110});
  EXPECT_NEAR(TempoOf(all), 110, 2);
  const std::vector<double> half = told({.tempo_bpm = 110, .half_time = true});
  EXPECT_NEAR(TempoOf(half), 55, 1);
  for (size_t i = 1; i < half.size(); ++i)
    EXPECT_NEAR(half[i] - half[i - 1], 120.0 / 110, 0.1) << "another half from " << half[i];
  EXPECT_NEAR(TempoOf(told({.tempo_bpm = 110, .double_time = true})), 220, 4);
}

// The listener counts from a beat that is no downbeat as found, and hears all of them later.
TEST(BeatEar, CountsFromTheListenersDownbeat) {
  const MadeSong song = MakeSong({.seed = 3, .seconds = 30, .tempo = {{0, 110}}});
  const BeatHint about{.tempo_bpm = 110};
  std::vector<double> found, counted, later;
  const std::vector<double> beats = Told(song.mono, 12, &found, {about});
  Told(song.mono, 12, &counted, {.beats = about, .downbeat_s = song.downbeats[1] + 60.0 / 110});
  const auto in_bar = [&](double beat) {
    return std::fmod((beat - song.downbeats[0]) / (60.0 / 110) + 0.5, 4);
  };
  ASSERT_GT(counted.size(), 4U);
  for (const double one : counted) EXPECT_EQ(std::floor(in_bar(one)), 1) << one;
  const std::vector<double> nudged = Told(song.mono, 12, &later, {.beats = about, .later_s = 0.04});
  ASSERT_EQ(nudged.size(), beats.size());
  for (size_t i = 0; i < beats.size(); ++i) EXPECT_NEAR(nudged[i], beats[i] + 0.04, 0.02);
}

TEST(BeatEar, TakesHintsWhileItHears) {
  const MadeSong song = MakeSong({.seed = 3, .seconds = 30, .tempo = {{0, 110}}});
  BeatEar ear;
  std::vector<double> last;
  for (size_t at = 0; at < song.mono.size(); at += 441) {
    if (at == 441 * 600) ear.SetHint({{.tempo_bpm = 110, .half_time = true}});
    const BeatsAhead ahead =
        ear.Hear(std::span(song.mono).subspan(at, std::min<size_t>(441, song.mono.size() - at)));
    if (!ahead.beats.empty()) last = ahead.beats;
    ear.Wait();
  }
  EXPECT_NEAR(TempoOf(last), 55, 1);
}

TEST(BeatEar, DropsLateBeats) {
  BeatsAhead ahead{{1, 1.5, 2, 2.5, 3}, {1, 3}};
  ahead.Keep(1.5, 2.5);
  EXPECT_EQ(ahead.beats, (std::vector<double>{1.5, 2, 2.5}));
  EXPECT_TRUE(ahead.downbeats.empty());
}

TEST(BeatEar, GivesNothingInSilence) {
  EXPECT_TRUE(Told(std::vector<float>(20 * kModelSampleRate), 0).empty());
}

}  // namespace choreo::live::beat_ear_test
