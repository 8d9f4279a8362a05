#include "model/evaluation/song_beats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/audio/mfcc.h"
#include "model/core/random.h"

namespace choreo {
namespace {

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

TEST(BeatAlignment, IsAGaussianOfTheDistanceToTheNearestBeat) {
  constexpr double kUnsmoothed = 1;  // a frame a second: the Gaussian is a twelfth of a frame
  // Minima of speed at frames 3 and 8 (step i leads to frame i + 1).
  const std::vector<float> speeds = {3, 2, 1, 2, 3, 2, 1, 0.5F, 1, 2};
  EXPECT_DOUBLE_EQ(BeatAlignmentScore(speeds, std::vector<double>{3, 8, 60}, kUnsmoothed), 1);
  EXPECT_NEAR(BeatAlignmentScore(speeds, std::vector<double>{0, 11}, kUnsmoothed), std::exp(-0.5),
              1e-12);
  EXPECT_NEAR(BeatAlignmentScore(speeds, std::vector<double>{3}, kUnsmoothed),
              (1 + std::exp(-25.0 / 18)) / 2, 1e-12);
  EXPECT_EQ(BeatAlignmentScore(speeds, {}, kUnsmoothed), 0);
}

}  // namespace
}  // namespace choreo
