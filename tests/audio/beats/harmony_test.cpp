#include "model/audio/beats/harmony.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/audio/beats/beats.h"
#include "tests/audio/signals.h"

namespace choreo::harmony_test {
namespace {

constexpr double kFirst = 0.25, kPeriod = 0.5;  // seconds, of beats

/// Twenty seconds of drums that are alike on all beats, under chords of four beats each that begin
/// with beat `first`; or under one chord.
std::vector<float> Song(int first, bool changes) {
  std::vector<float> song = Drums(kFirst, kPeriod, "kh");
  for (size_t i = 0; i < song.size(); ++i) {
    const double t = static_cast<double>(i) / kModelSampleRate;
    const auto chord = static_cast<int>(std::floor(((t - kFirst) / kPeriod - first) / 4));
    const double root = changes && chord % 2 != 0 ? 293.7 : 220;
    for (const double above : {1.0, 1.26, 1.5})
      song[i] += static_cast<float>(0.03 * std::sin(2 * std::numbers::pi * root * above * t));
  }
  return song;
}

TEST(HarmonyTest, BarsBeginWhereChordsChange) {
  for (const int first : {0, 1, 2, 3}) {
    const std::vector<double> downbeats = FindBeats(Song(first, true)).DownbeatSeconds();
    EXPECT_GE(downbeats.size(), 8U);
    for (const double second : downbeats)
      EXPECT_NEAR(std::remainder(second - kFirst - first * kPeriod, 4 * kPeriod), 0, 0.07) << first;
  }
}

TEST(HarmonyTest, OneChordLeavesBarsToTheDrums) {
  const std::vector<float> song = Song(0, false);
  EXPECT_EQ(FindBeats(song).in_bar, TrackBeats(FindOnsets(song)).in_bar);
}

TEST(HarmonyTest, OctavesAreOnePitchClass) {
  EXPECT_EQ(ChromaOf(440), 0);
  EXPECT_EQ(ChromaOf(110), 0);
  EXPECT_EQ(ChromaOf(466.2), 1);
  EXPECT_EQ(ChromaOf(415.3), 11);
  for (const double hz : {0.0, 50.0, 5000.0}) EXPECT_EQ(ChromaOf(hz), -1);
}

}  // namespace
}  // namespace choreo::harmony_test
