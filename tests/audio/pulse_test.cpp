#include "model/audio/pulse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "model/audio/feature_stream.h"
#include "tests/audio/signals.h"

namespace choreo::pulse_test {

constexpr int kRate = 22050;

std::vector<float> Onsets(std::span<const float> wave, size_t chunk) {
  FeatureStream stream(kRate, 1);
  for (size_t at = 0; at < wave.size(); at += chunk)
    stream.Push(wave.subspan(at, std::min(chunk, wave.size() - at)));
  std::vector<float> onsets;
  for (int64_t row = 0; row < stream.final_rows(); ++row) onsets.push_back(stream.Sound(row).onset);
  return onsets;
}

std::vector<float> Onsets(std::span<const float> wave) { return Onsets(wave, wave.size()); }

Pulse After(const std::vector<float>& onsets, double seconds) {
  return HearPulse(std::span(onsets).first(static_cast<size_t>(30 * seconds)));
}

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

/// The largest distance between the pulse's next beats after `seconds` and the clicks.
double FurthestOff(const Pulse& pulse, double seconds, const std::vector<double>& times) {
  const double last_row = 30 * seconds - 1;
  double furthest = 0;
  for (int beat = 0; beat < 4; ++beat) {
    const double at = (last_row + pulse.next + beat * pulse.period) / 30;
    double off = std::numeric_limits<double>::infinity();
    for (const double time : times) off = std::min(off, std::abs(time - at));
    furthest = std::max(furthest, off);
  }
  return furthest;
}

TEST(PulseTest, LocksOntoClicksWithinSixSeconds) {
  for (const double bpm : {75.0, 90.0, 100.0, 120.0, 128.0}) {
    const std::vector<double> times = Times(20, 60 / bpm, 20, 60 / bpm);
    const std::vector<float> onsets = Onsets(ClicksAt(20, times));
    for (const double seconds : {6.0, 7.3, 13.0, 16.0}) {
      const Pulse pulse = After(onsets, seconds);
      EXPECT_TRUE(pulse.Certain()) << bpm << " after " << seconds;
      EXPECT_NEAR(60 * 30 / pulse.period, bpm, 0.02 * bpm) << seconds;
      EXPECT_LT(FurthestOff(pulse, seconds, times), 0.07) << bpm << " after " << seconds;
      EXPECT_GT(pulse.next, 0);
      EXPECT_LE(pulse.next, pulse.period);
    }
  }
}

TEST(PulseTest, FollowsATempoThatStepsByATenth) {
  for (const double bpm : {100.0, 120.0}) {
    for (const double factor : {0.9, 1.1}) {
      const std::vector<double> times = Times(30, 60 / bpm, 15, 60 / bpm / factor);
      const std::vector<float> onsets = Onsets(ClicksAt(30, times));
      // Four seconds, and until the next click.
      const Pulse pulse = After(onsets, 19.5);
      EXPECT_NEAR(60 * 30 / pulse.period, bpm * factor, 0.02 * bpm) << factor;
      EXPECT_LT(FurthestOff(pulse, 19.5, times), 0.07) << bpm << " times " << factor;
    }
  }
}

TEST(PulseTest, SoftMusicHasTheSamePulse) {
  const std::vector<double> times = Times(10, 0.5, 10, 0.5);
  std::vector<float> wave = ClicksAt(10, times);
  const Pulse loud = After(Onsets(wave), 9);
  for (float& sample : wave) sample *= 0.02F;
  const Pulse soft = After(Onsets(wave), 9);
  EXPECT_TRUE(soft.Certain());
  EXPECT_NEAR(soft.period, loud.period, 0.1);
  EXPECT_NEAR(soft.next, loud.next, 0.5);
}

TEST(PulseTest, LowDrumDecidesThePhase) {
  for (const double bpm : {100.0, 135.0}) {
    const std::vector<double> beats = Times(20, 60 / bpm, 20, 60 / bpm);
    const std::vector<float> onsets = Onsets(Metal(20, 60 / bpm));
    for (const double seconds : {8.0, 15.0}) {
      const Pulse pulse = After(onsets, seconds);
      EXPECT_TRUE(pulse.Certain()) << bpm << " after " << seconds;
      EXPECT_LT(FurthestOff(pulse, seconds, beats), 0.07) << bpm << " after " << seconds;
    }
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

double CertainShare(const std::vector<float>& onsets) {
  int certain = 0, all = 0;
  for (double seconds = 3; 30 * seconds <= static_cast<double>(onsets.size()); seconds += 1.5) {
    certain += After(onsets, seconds).Certain();
    ++all;
  }
  return static_cast<double>(certain) / all;
}

TEST(PulseTest, NoBeatsWithoutAPulse) {
  EXPECT_EQ(CertainShare(Onsets(std::vector<float>(30 * kRate, 0.0F))), 0);
  EXPECT_EQ(CertainShare(Onsets(Noise(30 * kRate, 3, 0.3))), 0);
  EXPECT_EQ(CertainShare(Onsets(Sine(220, kRate, 30 * kRate, 0.3))), 0);
  double babble = 0;
  for (uint32_t seed = 1; seed <= 4; ++seed) babble += CertainShare(Onsets(Babble(40, seed))) / 4;
  EXPECT_LT(babble, 0.1);
  EXPECT_EQ(HearPulse({}).period, 0);
  EXPECT_FALSE(HearPulse({}).Certain());
}

TEST(PulseTest, NoBeatsAfterTheMusicStops) {
  std::vector<float> wave = ClicksAt(20, Times(20, 0.5, 20, 0.5));
  std::fill(wave.begin() + 12 * kRate, wave.end(), 0.0F);
  const std::vector<float> onsets = Onsets(wave);
  EXPECT_TRUE(After(onsets, 12).Certain());
  EXPECT_TRUE(After(onsets, 13.5).Certain());  // a short break has beats
  for (const double seconds : {15.0, 16.0, 18.0})
    EXPECT_FALSE(After(onsets, seconds).Certain()) << seconds;
}

TEST(PulseTest, OnsetsDoNotDependOnHowSamplesAreCut) {
  const std::vector<float> wave = ClicksAt(4, Times(4, 0.5, 4, 0.5));
  const std::vector<float> whole = Onsets(wave);
  ASSERT_GT(whole.size(), 110u);
  EXPECT_GT(*std::max_element(whole.begin(), whole.end()), 1);
  for (const size_t chunk : {size_t{1}, size_t{7}, size_t{735}, size_t{5000}})
    EXPECT_EQ(Onsets(wave, chunk), whole) << chunk;
}

TEST(PulseTest, LaterStreamStartGivesTheSameBeats) {
  const std::vector<float> wave = ClicksAt(20, Times(20, 0.5, 20, 0.5));
  const std::vector<float> whole = Onsets(wave);
  constexpr int64_t kRow = 500;
  const int64_t first =
      FeatureStream::FirstSampleFor(kRow - kPulseMemory - RowOnset::kMemory, kRate);
  ASSERT_GT(first, 0);
  FeatureStream later(kRate, 1, first);
  later.Push(std::span(wave).subspan(static_cast<size_t>(first)));
  std::vector<float> onsets;
  for (int64_t row = kRow - kPulseMemory; row < kRow; ++row)
    onsets.push_back(later.Sound(row).onset);
  EXPECT_TRUE(std::equal(onsets.begin(), onsets.end(), whole.begin() + kRow - kPulseMemory));
  const Pulse all = HearPulse(std::span(whole).first(kRow)), part = HearPulse(onsets);
  EXPECT_EQ(part.next, all.next);
  EXPECT_EQ(part.period, all.period);
  EXPECT_EQ(part.confidence, all.confidence);
}

}  // namespace choreo::pulse_test
