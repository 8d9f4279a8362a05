#include "model/audio/beats/beats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/audio/beats/beat_hint.h"
#include "model/audio/music/made_song.h"
#include "model/core/error.h"
#include "model/metrics/song_beats.h"
#include "tests/audio/signals.h"

namespace choreo::beats_test {
namespace {

std::vector<double> Every(double period, double first, double end) {
  std::vector<double> beats;
  for (double beat = first; beat < end; beat += period) beats.push_back(beat);
  return beats;
}

}  // namespace

TEST(BeatsTest, ClickTracksAreCountedAtTheirTempo) {
  for (const int64_t period : {9216, 10240, 11776, 13312}) {  // samples: 144 to 99 a minute
    const int64_t first = 7000, samples = 20 * 22050;
    const BeatTrack track = FindBeats(Clicks(samples, first, period));
    EXPECT_NEAR(track.tempo_bpm * static_cast<double>(period) / (60 * 22050), 1, 0.005);
    std::vector<double> clicks;
    for (int64_t at = first; at < samples; at += period)
      clicks.push_back(static_cast<double>(at) / 22050);
    EXPECT_GT(BeatFMeasure(track.Seconds(), clicks), 0.97) << period;
  }
}

TEST(BeatsTest, ClicksAreFoundAtTheirTimes) {
  const double period = 11264.0 / 22050;
  const BeatTrack track = FindBeats(Clicks(20 * 22050, 7000, 11264));
  ASSERT_GT(track.frames.size(), 30u);
  double late = 0;  // seconds
  for (const double beat : track.Seconds()) {
    const double since = beat - 7000.0 / 22050;
    late +=
        (since - std::round(since / period) * period) / static_cast<double>(track.frames.size());
  }
  EXPECT_LT(std::abs(late), 0.015);
}

// Seeds that nothing was developed with.
TEST(BeatsTest, BackbeatsAreCountedAtTheirTempoEvenIfFast) {
  for (const double bpm : {80.0, 140.0, 170.0, 190.0}) {
    SongPlan plan{
        .seed = 9'000'000 + static_cast<uint64_t>(bpm), .seconds = 20, .tempo = {{0, bpm}}};
    const MadeSong song = MakeSong(plan);
    const BeatTrack track = FindBeats(song.mono);
    EXPECT_GT(BeatFMeasure(track.Seconds(), song.beats), 0.9) << bpm << ", " << song.groove;
    EXPECT_NEAR(track.tempo_bpm, bpm, 0.01 * bpm) << song.groove;
    EXPECT_EQ(track.beats_in_bar, 4);
  }
}

TEST(BeatsTest, TempoMayChangeAtOnceAndBitByBit) {
  const auto hear = [](std::vector<SongPlan::Tempo> tempo) {
    const MadeSong song = MakeSong({.seed = 9'000'100, .seconds = 40, .tempo = std::move(tempo)});
    return std::pair(FindBeats(song.mono).Seconds(), song.beats);
  };
  const auto [stepped, steps] = hear({{0, 120}, {20, 120}, {20, 85}});
  EXPECT_GT(BeatFMeasure(stepped, steps, 0, 20), 0.9);
  EXPECT_GT(BeatFMeasure(stepped, steps, 24, 40), 0.9);
  const auto [ramped, ramp] = hear({{0, 100}, {5, 100}, {35, 130}});
  EXPECT_GT(BeatFMeasure(ramped, ramp), 0.9);
}

TEST(BeatsTest, SilentPartsHaveNone) {
  SongPlan plan{.seed = 9'000'200, .seconds = 30, .tempo = {{0, 110}}};
  plan.silent = {{10, 17}};
  const MadeSong song = MakeSong(plan);
  const std::vector<double> beats = FindBeats(song.mono).Seconds();
  for (const double beat : beats) EXPECT_FALSE(beat > 10 + 60.0 / 110 + 0.1 && beat < 16.9) << beat;
  EXPECT_GT(BeatFMeasure(beats, song.beats, 0, 10), 0.9);
  EXPECT_GT(BeatFMeasure(beats, song.beats, 19, 30), 0.9);
}

// Noise has onsets, but none that return.
TEST(BeatsTest, PartsWithoutAPulseHaveNone) {
  for (const double seconds : {8, 30}) {
    const auto samples = static_cast<int64_t>(seconds * 22050);
    EXPECT_TRUE(FindBeats(Sine(220, 22050, samples, 0.3)).frames.empty());
    for (uint64_t seed = 0; seed < 4; ++seed)
      EXPECT_TRUE(FindBeats(Noise(samples, seed, 0.1)).frames.empty()) << seconds << ", " << seed;
  }
  // Hiss in a pause.
  const MadeSong song =
      MakeSong({.seed = 9'000'250, .seconds = 35, .tempo = {{0, 128}}, .silent = {{12, 20}}});
  std::vector<float> hissing = Noise(std::ssize(song.mono), 3, 0.002);
  for (size_t i = 0; i < hissing.size(); ++i) hissing[i] += song.mono[i];
  const std::vector<double> beats = FindBeats(hissing).Seconds();
  EXPECT_GT(BeatFMeasure(beats, song.beats), 0.97);
  EXPECT_LE(std::ranges::count_if(beats, [](double beat) { return beat > 12.5 && beat < 19.5; }),
            2);
}

// Chords that swell and fade had up to 56 beats.
TEST(BeatsTest, SwellingChordsHaveNone) {
  for (const uint64_t seed : {9'000'260, 9'000'261, 9'000'262}) {
    const SongPlan plan{.seed = seed, .seconds = 40, .tempo = {{0, 90}}, .only_pad = true};
    EXPECT_TRUE(FindBeats(MakeSong(plan).mono).frames.empty()) << seed;
  }
}

// The first and last four beats beside a pad were lost.
TEST(BeatsTest, DrumsBesideAPadKeepTheirFirstAndLastBeats) {
  constexpr int64_t kRate = 22050, kPad = 12 * kRate;
  for (const double bpm : {100, 128, 150}) {
    for (const double gain : {0.02, 0.2}) {
      const std::vector<float> pad = Sine(220, kRate, kPad, gain),
                               drums = Drums(0, 60 / bpm, "khsh");
      std::vector<float> song = pad;
      song.insert(song.end(), drums.begin(), drums.end());
      song.insert(song.end(), pad.begin(), pad.end());
      const std::vector<double> heard = FindBeats(song).Seconds();
      EXPECT_GT(BeatFMeasure(heard, Every(60 / bpm, 12, 32), 0, 44), 0.97) << bpm << ", " << gain;
      EXPECT_NEAR(heard.front(), 12, 0.07) << bpm << ", " << gain;
      // The pad that starts may draw the very last one.
      EXPECT_GT(heard.back(), 32 - 2.2 * 60 / bpm) << bpm << ", " << gain;
    }
  }
}

// Guitars that are louder than the drums, half a beat later.
TEST(BeatsTest, LoudOffBeatsAreAPulseToo) {
  const std::vector<float> metal = Metal(20, 0.5);
  EXPECT_GT(FindBeats(metal).frames.size(), 35u);
}

// Periods of an odd number of frames favoured beats half a beat late.
TEST(BeatsTest, TheBassDrumKeepsTheBeatWhereHatsSoundBetween) {
  for (const double frames : {43, 44, 45, 47, 50}) {
    for (const double first : {0.03, 0.2, 0.31}) {
      for (const bool snared : {false, true}) {
        const double period = frames / kOnsetRate;
        const BeatTrack track = FindBeats(Drums(first, period, snared ? "khbh" : "kh"));
        EXPECT_GT(BeatFMeasure(track.Seconds(), Every(period, first, 20)), 0.95)
            << frames << " frames from " << first << (snared ? ", snared" : "");
      }
    }
  }
}

// Patterns learned that hats fall between beats.
TEST(BeatsTest, KickAndSnareWithoutHatsAreTwoBeats) {
  for (const double bpm : {70, 90, 100, 110, 128, 150}) {
    for (const char* steps : {"k.s.", "k.b.", "k.skk.s."}) {
      const BeatTrack track = FindBeats(Drums(0.2, 60 / bpm, steps));
      EXPECT_GT(BeatFMeasure(track.Seconds(), Every(60 / bpm, 0.2, 20)), 0.95)
          << bpm << " " << steps;
    }
  }
}

// Beats that are heard from the bass, or two of a kind, must not depend on what follows.
TEST(BeatsTest, DrumsKeepTheirBeatBesideAPartWithoutThem) {
  for (const double bpm : {100, 128, 150}) {
    for (const char* steps : {"kh", "k.s.", "khsh"}) {
      std::vector<float> song = Drums(0.2, 60 / bpm, steps);
      const std::vector<float> after = BrokenChord(20, 30 / bpm);
      song.insert(song.end(), after.begin(), after.end());
      EXPECT_GT(BeatFMeasure(FindBeats(song).Seconds(), Every(60 / bpm, 0.2, 20), 0, 19), 0.95)
          << bpm << " " << steps;
    }
  }
}

// Two beats were one, because only the first of a bar differs.
TEST(BeatsTest, BeatsAreAlikeButForTheFirstOfABar) {
  for (const double bpm : {100, 120, 126, 140, 150}) {
    for (const auto& [chords, drums] :
         {std::pair{"cccc", "kttt"}, {"cccc", "krrr"}, {"c.c.", "kttt"}, {"c...", "kttt"}}) {
      const std::vector<float> song = ChordsAndDrums(60 / bpm, chords, drums);
      EXPECT_GT(BeatFMeasure(FindBeats(song).Seconds(), Every(60 / bpm, 0.2, 20)), 0.95)
          << bpm << " " << chords << " " << drums;
    }
  }
}

// A chord a bar was beaten at half or three quarters of the tempo of the drums that follow.
TEST(BeatsTest, AnIntroOfOneChordABarHasTheDrumsTempo) {
  for (const double bpm : {100, 128, 140}) {
    const double period = 60 / bpm;
    std::vector<float> song = ChordsAndDrums(period, "c...", ".");
    const double bars = std::floor(19 / (4 * period));
    song.resize(static_cast<size_t>(bars * 4 * period * 22050));
    const std::vector<float> drums = Drums(0.2, period, "khsh");
    song.insert(song.end(), drums.begin(), drums.end());
    const double end = bars * 4 * period + 20;
    EXPECT_GT(BeatFMeasure(FindBeats(song).Seconds(), Every(period, 0.2, end)), 0.9) << bpm;
  }
}

// A beat was found 11 ms before the end, where the next kick would have been.
TEST(BeatsTest, ASongHasNoneAtItsVeryEnd) {
  for (const char* steps : {"k.", "kh", "k.s.", "khsh"}) {
    for (const int per_song : {32, 40, 48}) {
      const double period = 20.0 / per_song;
      EXPECT_NEAR(FindBeats(Drums(0, period, steps)).Seconds().back(), 20 - period, 0.03) << steps;
    }
  }
}

// The search near half of the tempo gave the hats between the beats, or jumped from one to another.
TEST(BeatsTest, AHintOfAMultipleOfTheTempoKeepsToTheBeats) {
  const std::vector<Onset> onsets = FindOnsets(Drums(0.2, 0.5, "khsh"));
  const auto track = [&](double bpm) { return TrackNear({.tempo_bpm = bpm}, onsets).Seconds(); };
  const std::vector<double> half = track(60), as_half = track(62);
  EXPECT_GT(std::max(BeatFMeasure(half, Every(1, 0.2, 20)), BeatFMeasure(half, Every(1, 0.7, 20))),
            0.95);
  EXPECT_EQ(as_half, half) << "it is searched near the hint";
  for (const double bpm : {60, 80, 90}) {
    const MadeSong song =
        MakeSong({.seed = 9'000'500, .seconds = 20, .tempo = {{0, bpm}}, .swing = true});
    std::vector<double> halves;
    for (size_t i = 0; i + 1 < song.beats.size(); ++i)
      halves.insert(halves.end(), {song.beats[i], (song.beats[i] + song.beats[i + 1]) / 2});
    const BeatTrack twice = TrackNear({.tempo_bpm = 2 * bpm}, FindOnsets(song.mono));
    EXPECT_GT(BeatFMeasure(twice.Seconds(), halves), 0.95) << bpm;
    EXPECT_NEAR(twice.tempo_bpm, 2 * bpm, 1);
  }
}

TEST(BeatsTest, DcOffsetAndItsEndAreIgnored) {
  for (const uint64_t seed : {9'000'300, 9'000'301, 9'000'302}) {
    std::vector<float> song = MakeSong({.seed = seed, .seconds = 15}).mono;
    for (float& sample : song) sample *= 0.5F;
    const BeatTrack plain = FindBeats(song);
    for (const float offset : {0.4F, -0.8F}) {
      std::vector<float> raised = song;
      for (float& sample : raised) sample += offset;
      EXPECT_EQ(FindBeats(raised).DownbeatSeconds(), plain.DownbeatSeconds());
    }
  }
}

TEST(BeatsTest, BeatsAscendWithinTheLimitsInAnyMusic) {
  for (uint64_t seed = 0; seed < 6; ++seed) {
    const std::vector<float> clicks =
        Clicks(10 * 22050, 3000, 9000 + 1500 * static_cast<int64_t>(seed));
    for (const TempoLimits limits : {TempoLimits{}, TempoLimits{90, 100}}) {
      const BeatTrack track = TrackBeats(FindOnsets(clicks), limits);
      ASSERT_EQ(track.in_bar.size(), track.frames.size());
      ASSERT_EQ(track.confidence.size(), track.frames.size());
      for (size_t i = 0; i < track.frames.size(); ++i) {
        EXPECT_GE(track.confidence[i], 0);
        EXPECT_LE(track.confidence[i], 1);
        EXPECT_LT(track.in_bar[i], 4);
        if (i == 0) continue;
        const double step = static_cast<double>(track.frames[i] - track.frames[i - 1]);
        EXPECT_GE(step, std::floor(5400 / limits.fastest_bpm));
        EXPECT_LE(step, std::ceil(5400 / limits.slowest_bpm));
      }
    }
  }
}

TEST(BeatsTest, SilenceHasNeitherTempoNorBeats) {
  const BeatTrack silence = FindBeats(std::vector<float>(50000, 0.0f));
  EXPECT_EQ(silence.tempo_bpm, 0);
  EXPECT_TRUE(silence.frames.empty());
  EXPECT_TRUE(TrackBeats({}).frames.empty());
  EXPECT_TRUE(FindBeats(Noise(100, 1)).frames.empty());
  EXPECT_THROW(FindBeats({}), Error);
}

TEST(BeatsTest, TempoIsThatOfMostBeats) {
  EXPECT_EQ(TempoOf({}), 0);
  EXPECT_NEAR(TempoOf(std::vector<double>{0, 0.5, 1, 1.5, 3, 3.5}), 120, 1e-9);
}

TEST(BeatsTest, PartsWithoutBeatsAreTold) {
  using Spans = std::vector<std::pair<double, double>>;
  EXPECT_EQ(WithoutBeats({}, 30), (Spans{{0, 30}}));
  const std::vector<double> beats{5, 6, 7, 15, 16};
  EXPECT_EQ(WithoutBeats(beats, 20), (Spans{{0, 5}, {7, 15}}));
  EXPECT_EQ(WithoutBeats(beats, 21), (Spans{{0, 5}, {7, 15}, {16, 21}}));
}

TEST(BeatsTest, SecondsCountFromTheFirstSample) {
  const BeatTrack track{.tempo_bpm = 120, .beats_in_bar = 2, .frames = {0, 90}, .in_bar = {1, 0}};
  EXPECT_EQ(track.Seconds(), (std::vector<double>{0, 1}));
  EXPECT_EQ(track.DownbeatSeconds(), (std::vector<double>{1}));
}

}  // namespace choreo::beats_test
