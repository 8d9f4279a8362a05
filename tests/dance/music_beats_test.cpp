#include "model/dance/music_beats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/dance/dances.h"
#include "tests/support/expect_error.h"

namespace choreo {
namespace {

// Of a song that beats every half second.
double Off(double seconds) { return std::abs(seconds - 0.5 * std::round(2 * seconds)); }

TEST(MusicBeats, ALiveDanceHearsThem) {
  const auto scheduler = FakeScheduler();
  const Recording recording = Perform(*scheduler, LiveDance(41, 20));
  ASSERT_TRUE(recording.summary);
  ASSERT_FALSE(recording.beats.empty());
  EXPECT_LT(recording.beats.front().seconds, 6);
  size_t heard = 0, late = 0;
  for (size_t i = 0; i < recording.beats.size(); ++i) {
    const MusicBeat& beat = recording.beats[i];
    EXPECT_LT(Off(beat.seconds), 0.07) << beat.seconds;
    EXPECT_GT(beat.confidence, 0);
    if (i > 0) {
      EXPECT_NEAR(beat.seconds - recording.beats[i - 1].seconds, 0.5, 0.07);
    }
    heard += beat.source == MusicBeat::Source::kHeard;
    late += beat.seconds >= 8;
  }
  EXPECT_GE(late, 23U);
  EXPECT_GT(heard, recording.beats.size() / 2);
  EXPECT_TRUE(recording.summary->beat_hit_rate);
}

// What is told is what is danced to.
TEST(MusicBeats, TheDanceIsTimedToThem) {
  const auto scheduler = FakeScheduler();
  Dance dance = LiveDance(42, 12);
  const Recording heard = Perform(*scheduler, dance);
  for (double beat = 0.5; beat < 12; beat += 0.5) dance.config.music_beats.push_back(beat);
  const Recording given = Perform(*scheduler, dance);
  EXPECT_FALSE(SameDance(heard, given));
  ASSERT_EQ(given.beats.size(), 23U);
  EXPECT_EQ(given.beats.front().source, MusicBeat::Source::kGiven);
}

TEST(MusicBeats, NoiseAndSilenceHaveNone) {
  const auto scheduler = FakeScheduler();
  Dance dance = LiveDance(43, 15);
  std::mt19937 random(5);
  for (const float loudness : {0.3F, 0.0F}) {
    std::uniform_real_distribution<float> noise(-1, 1);
    for (float& sample : dance.samples) sample = loudness * noise(random);
    EXPECT_TRUE(Perform(*scheduler, dance).beats.empty()) << loudness;
  }
}

// Neither how the music is cut nor when it comes changes what is heard.
TEST(MusicBeats, ArePureInTheSamples) {
  const auto scheduler = FakeScheduler();
  Dance dance = LiveDance(44, 16);
  const Recording expected = Perform(*scheduler, dance);
  for (const int64_t chunk : {735, 10'007, 1'000'000}) {
    auto sink = std::make_shared<Recorder>();
    DanceStream stream(*scheduler, dance.config, sink);
    for (const Key& key : dance.keys) SendKey(stream, key);
    stream.KeysComplete();
    const auto samples = static_cast<int64_t>(dance.samples.size());
    for (int64_t at = 0; at < samples; at += chunk) {
      const int64_t end = std::min(samples, at + chunk);
      stream.PushAudio(
          std::span(dance.samples).subspan(static_cast<size_t>(at), static_cast<size_t>(end - at)),
          at);
      // Each piece is danced before the next one comes.
      const int64_t frames = (end - 1024) / 735;
      if (frames > 0) sink->WaitForFrames(static_cast<size_t>(frames));
    }
    stream.EndOfAudio();
    const Recording recording = sink->WaitForEnd();
    EXPECT_TRUE(SameDance(expected, recording)) << chunk;
    ASSERT_EQ(recording.beats.size(), expected.beats.size()) << chunk;
    for (size_t i = 0; i < expected.beats.size(); ++i)
      EXPECT_EQ(recording.beats[i].seconds, expected.beats[i].seconds);
  }
}

// A DJ's program knows better.
TEST(MusicBeats, AreGivenWhileTheDanceGoesOn) {
  const auto scheduler = FakeScheduler();
  Dance dance = LiveDance(45, 16);
  dance.config.generate_until = 0;
  const auto play = [&](const DanceConfig& config, bool patient) {
    auto sink = std::make_shared<Recorder>();
    DanceStream stream(*scheduler, config, sink);
    SendSong(stream, dance, config.audio->first_sample);
    for (int64_t frame = 30; frame <= 450; frame += 30) {
      stream.GenerateUntil(frame);
      const int64_t due = frame - config.FirstFrame();
      if (patient && due > 0) sink->WaitForFrames(static_cast<size_t>(due));
      // Beats a third of a second behind the music's, of which the first two come too late.
      if (frame == 240) stream.GiveBeats({7.3, 7.8, 8.3, 8.8, 9.3, 9.8, 10.3, 10.8, 11.3});
    }
    stream.HalfClose();
    return sink->WaitForEnd();
  };
  const Recording recording = play(dance.config, true);
  ASSERT_TRUE(recording.summary);
  ASSERT_EQ(recording.warnings.size(), 1U);
  EXPECT_EQ(recording.warnings[0].kind, DanceWarning::Kind::kBeatsTooLate);
  EXPECT_EQ(recording.warnings[0].frame, 219);
  std::vector<double> given;
  double heard_behind = 0;
  for (const MusicBeat& beat : recording.beats) {
    if (beat.source == MusicBeat::Source::kGiven)
      given.push_back(beat.seconds);
    else if (!given.empty())
      heard_behind = beat.seconds;
  }
  EXPECT_EQ(given, (std::vector<double>{8.3, 8.8, 9.3, 9.8, 10.3, 10.8, 11.3}));
  EXPECT_GT(heard_behind, 14) << "behind the last one it listens again";
  EXPECT_TRUE(SameDance(recording, play(dance.config, false)));
  for (const Continuation& continuation : recording.continuations) {
    if (continuation.frame >= 480) break;
    DanceConfig config = dance.config;
    config.continuation = continuation;
    config.audio->first_sample = *continuation.audio_from_sample;
    EXPECT_TRUE(SameDance(recording, play(config, true))) << continuation.frame;
  }
}

TEST(MusicBeats, AreBoundedAndComeBeforeTheKeysAreComplete) {
  const auto scheduler = FakeScheduler();
  DanceStream stream(*scheduler, LiveDance(46, 1).config, std::make_shared<Recorder>());
  std::vector<double> many;
  for (size_t i = 0; i < kMostBeats; ++i) many.push_back(0.05 * static_cast<double>(i));
  stream.GiveBeats(many);
  ExpectError(ErrorCode::kInvalidArgument, "music_beats[1].times", [&] { stream.GiveBeats({1}); });
  stream.KeysComplete();
  ExpectError(ErrorCode::kInvalidArgument, "music_beats[1].times", [&] { stream.GiveBeats({1}); });
}

// Only what lies before a transition says where it beats.
TEST(MusicBeats, WhatFollowsChangesNothing) {
  std::vector<float> song = Song(22050, 20);
  const auto around = [&song] {
    AudioFeed feed(22050, 1, 0);
    feed.Push(song, 0, [] {});
    feed.Finish();
    return MusicBeats(30, {}, std::nullopt, &feed).Around(300, 360);
  };
  const std::vector<double> heard = around();
  ASSERT_FALSE(heard.empty());
  EXPECT_LT(heard.front(), 0);
  EXPECT_GE(heard.back(), 60);
  for (size_t i = 300 * 735 + 2000; i < song.size(); ++i) song[i] = 0;
  EXPECT_EQ(around(), heard);
}

}  // namespace
}  // namespace choreo
