#include "model/audio/beats/beats_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "model/audio/music/feature_stream.h"
#include "model/audio/music/made_song.h"
#include "tests/audio/signals.h"

namespace choreo::beats_ahead_test {

constexpr int kRate = 22050;

std::vector<Onset> Onsets(std::span<const float> wave, size_t chunk) {
  FeatureStream stream(kRate, 1);
  for (size_t at = 0; at < wave.size(); at += chunk)
    stream.Push(wave.subspan(at, std::min(chunk, wave.size() - at)));
  std::vector<Onset> onsets;
  for (int64_t row = 0; row < stream.final_rows(); ++row) {
    const auto& of_row = stream.Sound(row).onsets;
    onsets.insert(onsets.end(), of_row.begin(), of_row.end());
  }
  return onsets;
}

std::vector<Onset> Onsets(std::span<const float> wave) { return Onsets(wave, wave.size()); }

/// The beats of the next two seconds, as far as the last twelve tell.
BeatsAhead After(const std::vector<Onset>& onsets, double seconds) {
  const auto until = static_cast<size_t>(seconds * kOnsetRate);
  const size_t from = until - std::min<size_t>(until, 12 * kOnsetRate);
  const HeardBeats heard =
      HearBeats(std::span(onsets).subspan(from, until - from), static_cast<int64_t>(from));
  if (!heard.Certain()) return {};
  return PredictBeats(heard.track, seconds, seconds + 2);
}

double PeriodOf(const BeatsAhead& ahead) { return ahead.beats[1] - ahead.beats[0]; }

/// Click times, `period` apart until `change`, and `then` apart afterwards; seconds.
std::vector<double> Times(double seconds, double period, double change, double then) {
  std::vector<double> times;
  for (double t = 0.3; t < seconds; t += t < change ? period : then) times.push_back(t);
  return times;
}

std::vector<float> ClicksAt(double seconds, const std::vector<double>& times, float amplitude = 1) {
  std::vector<float> wave = Noise(static_cast<int64_t>(seconds * kRate), 9, 0.001);
  const std::vector<float> click = Clicks(600, 0, 600);
  for (const double time : times) {
    const auto at = static_cast<size_t>(time * kRate);
    for (size_t i = 0; i < click.size() && at + i < wave.size(); ++i)
      wave[at + i] += amplitude * click[i];
  }
  return wave;
}

/// The largest distance between a beat ahead and the nearest click.
double FurthestOff(const BeatsAhead& ahead, const std::vector<double>& times) {
  double furthest = 0;
  for (const double beat : ahead.beats) {
    double off = std::numeric_limits<double>::infinity();
    for (const double time : times) off = std::min(off, std::abs(time - beat));
    furthest = std::max(furthest, off);
  }
  return furthest;
}

TEST(BeatsAheadTest, LocksOntoClicksWithinEightBeatsAndASecond) {
  for (const double bpm : {75.0, 90.0, 100.0, 120.0, 128.0}) {
    const std::vector<double> times = Times(20, 60 / bpm, 20, 60 / bpm);
    const std::vector<Onset> onsets = Onsets(ClicksAt(20, times));
    for (const double seconds : {9 * 60 / bpm + 1.3, 9.7, 13.0, 16.0}) {
      const BeatsAhead ahead = After(onsets, seconds);
      ASSERT_GE(ahead.beats.size(), 2U) << bpm << " after " << seconds;
      EXPECT_NEAR(60 / PeriodOf(ahead), bpm, 0.02 * bpm) << seconds;
      EXPECT_LT(FurthestOff(ahead, times), 0.07) << bpm << " after " << seconds;
      EXPECT_GT(ahead.beats.front(), seconds);
      EXPECT_LT(ahead.beats.back(), seconds + 2);
    }
  }
}

TEST(BeatsAheadTest, FollowsATempoThatStepsByATenth) {
  for (const double bpm : {100.0, 120.0}) {
    for (const double factor : {0.9, 1.1}) {
      const std::vector<double> times = Times(30, 60 / bpm, 15, 60 / bpm / factor);
      const std::vector<Onset> onsets = Onsets(ClicksAt(30, times));
      const BeatsAhead ahead = After(onsets, 22);  // a little more than eight beats
      ASSERT_GE(ahead.beats.size(), 2U);
      EXPECT_NEAR(60 / PeriodOf(ahead), bpm * factor, 0.02 * bpm) << factor;
      EXPECT_LT(FurthestOff(ahead, times), 0.07) << bpm << " times " << factor;
    }
  }
}

TEST(BeatsAheadTest, SoftMusicHasBeats) {
  const std::vector<double> times = Times(12, 0.5, 12, 0.5);
  std::vector<float> wave = ClicksAt(10, times);
  for (float& sample : wave) sample *= 0.02F;
  const BeatsAhead soft = After(Onsets(wave), 9);
  ASSERT_FALSE(soft.beats.empty());
  EXPECT_LT(FurthestOff(soft, times), 0.07);
}

TEST(BeatsAheadTest, BarsGoOn) {
  const MadeSong song = MakeSong({.seed = 40, .seconds = 16});
  const std::vector<Onset> onsets = Onsets(song.mono);
  std::vector<double> downbeats;
  for (double seconds = 8; seconds < 14; seconds += 2) {
    const BeatsAhead ahead = After(onsets, seconds);
    downbeats.insert(downbeats.end(), ahead.downbeats.begin(), ahead.downbeats.end());
  }
  ASSERT_GE(downbeats.size(), 2U);
  for (const double downbeat : downbeats) {
    double off = std::numeric_limits<double>::infinity();
    for (const double known : song.downbeats) off = std::min(off, std::abs(known - downbeat));
    EXPECT_LT(off, 0.07) << downbeat;
  }
}

// Bursts of random length, loudness and colour, four or five a second, and pauses now and then.
std::vector<float> Babble(double seconds, uint32_t seed) {
  std::mt19937 random(seed);
  const auto draw = [&random](double least, double most) {
    return least + (most - least) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<float> wave = Noise(static_cast<int64_t>(seconds * kRate), seed, 0.001);
  for (double at = 0.2; at < seconds;) {
    const double length = draw(0.08, 0.25), loud = draw(0.1, 0.4), hz = draw(150, 2500);
    const bool hiss = draw(0, 1) < 0.3;
    const auto first = static_cast<size_t>(at * kRate);
    const auto samples = static_cast<size_t>(length * kRate);
    const std::vector<float> noise = Noise(static_cast<int64_t>(samples), random(), 1);
    const std::vector<float> tone = Sine(hz, kRate, static_cast<int64_t>(samples));
    for (size_t i = 0; i < samples && first + i < wave.size(); ++i) {
      const double swell =
          std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(samples));
      wave[first + i] += static_cast<float>(loud * swell) * (hiss ? noise[i] : tone[i]);
    }
    at += length * draw(0.9, 1.3) + (draw(0, 1) < 0.12 ? draw(0.2, 0.8) : 0);
  }
  return wave;
}

/// The share of moments in which beats are predicted.
double CertainShare(const std::vector<Onset>& onsets) {
  int certain = 0, all = 0;
  for (double seconds = 3; seconds * kOnsetRate <= static_cast<double>(onsets.size());
       seconds += 1.5) {
    certain += !After(onsets, seconds).beats.empty();
    ++all;
  }
  return static_cast<double>(certain) / all;
}

TEST(BeatsAheadTest, NoneWithoutAPulse) {
  EXPECT_EQ(CertainShare(Onsets(std::vector<float>(30 * kRate, 0.0F))), 0);
  EXPECT_EQ(CertainShare(Onsets(Noise(30 * kRate, 3, 0.3))), 0);
  EXPECT_EQ(CertainShare(Onsets(Sine(220, kRate, 30 * kRate, 0.3))), 0);
  double babble = 0;
  for (uint32_t seed = 1; seed <= 4; ++seed) babble += CertainShare(Onsets(Babble(40, seed))) / 4;
  EXPECT_LT(babble, 0.1);
  EXPECT_TRUE(PredictBeats({}, 1, 2).beats.empty());
}

TEST(BeatsAheadTest, NoneAfterTheMusicStops) {
  std::vector<float> wave = ClicksAt(20, Times(20, 0.5, 20, 0.5));
  std::fill(wave.begin() + 12 * kRate, wave.end(), 0.0F);
  const std::vector<Onset> onsets = Onsets(wave);
  EXPECT_FALSE(After(onsets, 12).beats.empty());
  EXPECT_FALSE(After(onsets, 13.5).beats.empty()) << "a short break has beats";
  for (const double seconds : {16.0, 18.0})
    EXPECT_TRUE(After(onsets, seconds).beats.empty()) << seconds;
}

TEST(BeatsAheadTest, OnsetsDoNotDependOnHowSamplesAreCut) {
  const std::vector<float> wave = ClicksAt(4, Times(4, 0.5, 4, 0.5));
  const std::vector<Onset> whole = Onsets(wave);
  ASSERT_GT(whole.size(), 330u);
  EXPECT_GT(std::ranges::max(OnsetStrength(whole)), 1);
  for (const size_t chunk : {size_t{1}, size_t{7}, size_t{735}, size_t{5000}})
    EXPECT_EQ(Onsets(wave, chunk), whole) << chunk;
}

TEST(BeatsAheadTest, LaterStreamStartGivesTheSameOnsets) {
  const std::vector<float> wave = ClicksAt(20, Times(20, 0.5, 20, 0.5));
  const std::vector<Onset> whole = Onsets(wave);
  constexpr int64_t kRow = 140;
  const int64_t first = FeatureStream::FirstSampleFor(kRow - kRowSoundMemory, kRate);
  ASSERT_GT(first, 0);
  FeatureStream later(kRate, 1, first);
  later.Push(std::span(wave).subspan(static_cast<size_t>(first)));
  for (int64_t row = kRow; row < later.final_rows(); ++row) {
    const auto& onsets = later.Sound(row).onsets;
    EXPECT_TRUE(std::ranges::equal(
        onsets, std::span(whole).subspan(static_cast<size_t>(row) * kRowOnsets, kRowOnsets)))
        << row;
  }
}

}  // namespace choreo::beats_ahead_test
