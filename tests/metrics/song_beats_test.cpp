#include "model/metrics/song_beats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "model/audio/signal/mfcc.h"
#include "model/core/numbers/random.h"

namespace choreo::song_beats_test {

// Clicks of decaying noise at `bpm`, the first after `offset` seconds; MFCC rows [40, frames].
Eigen::MatrixXf Clicks(double bpm, double offset, double seconds) {
  Random random(3);
  std::vector<float> samples(static_cast<size_t>(22050 * seconds));
  for (float& sample : samples) sample = static_cast<float>(0.001 * random.Normal());
  for (double at = offset; at < seconds; at += 60 / bpm) {
    const auto start = static_cast<size_t>(at * 22050);
    for (size_t i = 0; i < 2000 && start + i < samples.size(); ++i) {
      samples[start + i] +=
          static_cast<float>(0.5 * random.Normal() * std::exp(-static_cast<double>(i) / 400));
    }
  }
  return Mfcc(samples).transpose();
}

TEST(SongBeats, AreFoundFromMfccRowsWithinAFrame) {
  for (const double bpm : {96.0, 120.0}) {
    const std::vector<double> beats = SongBeats(Clicks(bpm, 0.5, 20), 30);
    ASSERT_GT(beats.size(), 25U) << bpm;
    const double interval = 30 * 60 / bpm;
    for (const double beat : beats) {
      const double beats_in = (beat - 15) / interval;
      EXPECT_LT(std::abs(beats_in - std::round(beats_in)) * interval, 1.5) << bpm << " " << beat;
    }
  }
}

TEST(SongBeats, SilenceHasNone) {
  EXPECT_TRUE(SongBeats(Mfcc(std::vector<float>(22050 * 5)).transpose(), 30).empty());
  EXPECT_TRUE(SongBeats({}, 30).empty());
}

// Speeds of `frames` - 1 steps, least at each of `minima` by depth, rising evenly beside them.
std::vector<float> Valleys(int frames, const std::map<int, float>& minima) {
  std::vector<float> speeds(static_cast<size_t>(frames) - 1, 100);
  for (int frame = 1; frame < frames; ++frame) {  // step i leads to frame i + 1
    float& speed = speeds[static_cast<size_t>(frame) - 1];
    for (const auto& [minimum, depth] : minima)
      speed = std::min(speed, depth + static_cast<float>(std::abs(frame - minimum)));
  }
  return speeds;
}

TEST(BeatAlignment, IsAGaussianOfFiftyMillisecondsAtAnyRate) {
  const std::vector<float> one = Valleys(60, {{20, 0.0F}});
  EXPECT_DOUBLE_EQ(BeatAlignmentScore(one, std::vector<double>{20, 47}, 30), 1);
  for (const double fps : {30.0, 60.0}) {
    const double apart = 0.05 * fps;  // 1.5 and 3 frames
    for (const double beat : {20 - apart, 20 + apart})
      EXPECT_NEAR(BeatAlignmentScore(one, {&beat, 1}, fps), std::exp(-0.5), 1e-12) << fps;
    const double far = 20 + 2 * apart;
    EXPECT_NEAR(BeatAlignmentScore(one, {&far, 1}, fps), std::exp(-2), 1e-12) << fps;
  }
  // The mean over motion beats, each to its nearest music beat.
  const std::vector<float> two = Valleys(60, {{20, 0.0F}, {40, 1.0F}});
  EXPECT_NEAR(BeatAlignmentScore(two, std::vector<double>{0, 20, 38.5}, 30),
              (1 + std::exp(-0.5)) / 2, 1e-12);
}

TEST(BeatAlignment, AMotionBeatIsTheSlowestWithinASixthOfASecond) {
  const std::vector<double> music = {20};
  const double far = std::exp(-std::pow(6 / 1.5, 2) / 2);
  // Five frames at 30 fps, ten at 60: a shallower minimum counts from the next one on.
  EXPECT_DOUBLE_EQ(BeatAlignmentScore(Valleys(60, {{20, 0.0F}, {25, 0.5F}}), music, 30), 1);
  EXPECT_NEAR(BeatAlignmentScore(Valleys(60, {{20, 0.0F}, {26, 0.5F}}), music, 30), (1 + far) / 2,
              1e-12);
  EXPECT_DOUBLE_EQ(BeatAlignmentScore(Valleys(60, {{20, 0.0F}, {30, 0.5F}}), music, 60), 1);
  EXPECT_LT(BeatAlignmentScore(Valleys(60, {{20, 0.0F}, {31, 0.5F}}), music, 60), 0.51);
  // Nothing is smoothed: a single slow frame is a beat.
  std::vector<float> dip(59, 1.0F);
  for (size_t i = 0; i < dip.size(); ++i) dip[i] += 0.1F * static_cast<float>(i % 2);
  dip[19] = 0.5F;
  EXPECT_DOUBLE_EQ(BeatAlignmentScore(dip, music, 30), 1);
}

TEST(BeatAlignment, WithoutBeatsOfEitherKindIsNone) {
  const std::vector<double> music = {20};
  EXPECT_EQ(BeatAlignmentScore(Valleys(60, {{20, 0.0F}}), {}, 30), 0);
  // A body that stands still, or is slowest at an end, has no minimum.
  EXPECT_EQ(BeatAlignmentScore(std::vector<float>(59, 0.0F), music, 30), 0);
  EXPECT_EQ(BeatAlignmentScore(Valleys(60, {{1, 0.0F}}), music, 30), 0);
  EXPECT_EQ(BeatAlignmentScore(Valleys(60, {{59, 0.0F}}), music, 30), 0);
  EXPECT_EQ(BeatAlignmentScore({}, music, 30), 0);
}

}  // namespace choreo::song_beats_test
