#include "model/audio/beats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "model/audio/onset.h"
#include "model/core/error.h"
#include "tests/audio/signals.h"

namespace choreo::beats_test {

/// An onset envelope that is 1 every `period` frames from `first` on.
std::vector<float> Pulses(size_t frames, size_t first, size_t period) {
  std::vector<float> envelope(frames, 0.0f);
  for (size_t i = first; i < frames; i += period) envelope[i] = 1.0f;
  return envelope;
}

TEST(BeatsTest, ClickTracksAreCountedAtTheirTempo) {
  for (const int64_t period : {18, 20, 23, 26}) {  // in onset frames: 144 to 99 a minute
    const int64_t first = 7000, samples = 20 * 22050;
    const BeatTrack track = FindBeats(Clicks(samples, first, period * kOnsetHop));
    EXPECT_DOUBLE_EQ(track.tempo_bpm, 60.0 * 22050 / static_cast<double>(period * kOnsetHop));
    const int64_t clicks = (samples - first) / (period * kOnsetHop);
    EXPECT_GE(static_cast<int64_t>(track.frames.size()), clicks - 2);
    EXPECT_LE(static_cast<int64_t>(track.frames.size()), clicks + 1);
    // Between the outermost, which have a neighbour on one side only, every beat is a click, and
    // none is left out.
    for (size_t i = 1; i + 1 < track.frames.size(); ++i) {
      const double since_first =
          static_cast<double>(track.frames[i]) - static_cast<double>(first) / kOnsetHop;
      const double clicks_away = since_first / static_cast<double>(period);
      EXPECT_NEAR(since_first, std::round(clicks_away) * static_cast<double>(period), 1.5);
      if (i > 1) {
        EXPECT_NEAR(static_cast<double>(track.frames[i] - track.frames[i - 1]),
                    static_cast<double>(period), 1.0);
      }
    }
  }
}

TEST(BeatsTest, ClicksAreHeardWhenTheySound) {
  const BeatTrack track = FindBeats(Clicks(20 * 22050, 7000, 22 * kOnsetHop));
  ASSERT_GT(track.frames.size(), 30u);
  double late = 0;  // seconds
  for (size_t i = 1; i + 1 < track.frames.size(); ++i) {
    const double since = track.Seconds()[i] - 7000.0 / 22050, period = 22.0 * kOnsetHop / 22050;
    late += (since - std::round(since / period) * period) /
            static_cast<double>(track.frames.size() - 2);
  }
  EXPECT_LT(std::abs(late), 0.015);
}

TEST(BeatsTest, TheLowDrumSaysWhichHalfOfABeatIsTheBeat) {
  for (const double bpm : {100.0, 135.0}) {
    const double period = 60 / bpm;
    const std::vector<double> beats = FindBeats(Metal(30, period)).Seconds();
    ASSERT_GT(beats.size(), 40u);
    for (size_t i = 1; i + 1 < beats.size(); ++i) {
      const double turns = (beats[i] - 0.3) / period;
      EXPECT_LT(std::abs(turns - std::round(turns)) * period, 0.07) << bpm << " at " << beats[i];
    }
  }
}

TEST(BeatsTest, PulsesAreTheBeats) {
  const BeatTrack track = TrackBeats(Pulses(600, 10, 22));
  EXPECT_DOUBLE_EQ(track.tempo_bpm, 60.0 * 22050 / 512 / 22);
  ASSERT_GE(track.frames.size(), 25u);
  for (size_t i = 0; i < track.frames.size(); ++i) {
    EXPECT_EQ(track.frames[i], track.frames[0] + 22 * static_cast<int64_t>(i));
  }
  EXPECT_EQ((track.frames[0] - 10) % 22, 0);
}

TEST(BeatsTest, BeatsBridgeAGapAndDoNotBeginBeforeTheMusic) {
  std::vector<float> envelope = Pulses(900, 201, 20);
  for (size_t i = 441; i < 520; ++i) envelope[i] = 0;  // four beats are silent
  const BeatTrack track = TrackBeats(envelope);
  EXPECT_EQ(track.frames.front(), 201);
  for (size_t i = 1; i < track.frames.size(); ++i) {
    EXPECT_EQ(track.frames[i] - track.frames[i - 1], 20) << i;
  }
  EXPECT_GT(track.frames.back(), 850);
}

TEST(BeatsTest, BeatsAscendAndKeepNearTheTempoInAnyEnvelope) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<float> envelope = Noise(700, seed);
    for (float& value : envelope) value = std::abs(value);
    const BeatTrack track = TrackBeats(envelope);
    EXPECT_GT(track.tempo_bpm, 0);
    EXPECT_LT(track.tempo_bpm, 320);
    const double beat = std::round(60.0 * 22050 / 512 / track.tempo_bpm);
    EXPECT_GT(track.frames.size(), 2u);
    for (size_t i = 1; i < track.frames.size(); ++i) {
      const double step = static_cast<double>(track.frames[i] - track.frames[i - 1]);
      EXPECT_GE(step, std::floor(beat / 2));
      EXPECT_LE(step, 2 * beat);
    }
  }
}

TEST(BeatsTest, SilenceHasNeitherTempoNorBeats) {
  const BeatTrack silence = FindBeats(std::vector<float>(50000, 0.0f));
  EXPECT_EQ(silence.tempo_bpm, 0);
  EXPECT_TRUE(silence.frames.empty());
  EXPECT_TRUE(TrackBeats({}).frames.empty());
  EXPECT_TRUE(TrackBeats(std::vector<float>{1.0f}).frames.empty());
  EXPECT_TRUE(FindBeats(Noise(100, 1)).frames.empty());
  EXPECT_THROW(FindBeats({}), Error);
}

TEST(BeatsTest, SecondsCountFromTheFirstSample) {
  const BeatTrack track{120, {0, 100}};
  EXPECT_EQ(track.Seconds(), (std::vector<double>{0, 100 * 512.0 / 22050}));
}

}  // namespace choreo::beats_test
