#include "model/dance/input/dance_music.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>

#include "model/core/limits.h"
#include "model/dance/delivery/beat_schedule.h"
#include "tests/dance/dances.h"
#include "tests/support/expect_error.h"

namespace choreo::dance_music_test {

const ModelInfo model;  // at 30 frames a second

// Returns the beats of a transition that begins.
std::vector<Beat> Begin(DanceMusic* music, BeatSchedule* schedule, int64_t from, int64_t to) {
  const std::vector<Beat> beats = music->PlanFor({from, to}, from).Hear().beats;
  schedule->StartTransition(beats, from);
  return beats;
}

// The beats of a song with a beat every half second.
double Off(double seconds) { return std::abs(seconds - 0.5 * std::round(2 * seconds)); }

// 22 050 Hz.
std::vector<float> Drum(double seconds, double period) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> noise(-0.01F, 0.01F);
  std::vector<float> samples(static_cast<size_t>(22050 * seconds));
  for (size_t i = 0; i < samples.size(); ++i) {
    const double t = static_cast<double>(i) / 22050, since = std::fmod(t + period, period);
    samples[i] =
        static_cast<float>(0.6 * std::exp(-40 * since) * std::sin(560 * since)) + noise(random);
  }
  return samples;
}

TEST(MusicBeats, LiveDanceDetectsThem) {
  const auto queue = FakeQueue();
  for (const bool keyed : {true, false}) {
    Dance dance = LiveDance(41, 20);
    if (!keyed) {  // then each fourth beat is on a boundary
      dance.keys.clear();
      dance.samples = Drum(20, 0.5);
    }
    const Recording recording = Perform(*queue, dance);
    ASSERT_TRUE(recording.summary);
    ASSERT_FALSE(recording.beats.empty());
    EXPECT_LT(recording.beats.front().time_s, 7);
    size_t heard = 0, late = 0;
    for (size_t i = 0; i < recording.beats.size(); ++i) {
      const Beat& beat = recording.beats[i];
      EXPECT_LT(Off(beat.time_s), 0.07) << beat.time_s;
      EXPECT_GT(beat.confidence, 0);
      if (i > 0) {
        EXPECT_NEAR(beat.time_s - recording.beats[i - 1].time_s, 0.5, 0.07);
      }
      heard += beat.source == Beat::Source::kHeard;
      late += beat.time_s >= 8;
    }
    EXPECT_GE(late, 23U);
    EXPECT_GT(heard, recording.beats.size() / 2);
    EXPECT_TRUE(recording.summary->beat_hit_rate);
  }
}

// The dance uses the beats that are reported.
TEST(MusicBeats, TheDanceIsTimedToThem) {
  const auto queue = FakeQueue();
  Dance dance = LiveDance(42, 12);
  const Recording heard = Perform(*queue, dance);
  for (double beat = 0.5; beat < 12; beat += 0.5) dance.config.music_beats.push_back(beat);
  const Recording given = Perform(*queue, dance);
  EXPECT_FALSE(SameDance(heard, given));
  ASSERT_EQ(given.beats.size(), 23U);
  EXPECT_EQ(given.beats.front().source, Beat::Source::kGiven);
}

TEST(MusicBeats, NoiseAndSilenceHaveNone) {
  const auto queue = FakeQueue();
  Dance dance = LiveDance(43, 15);
  std::mt19937 random(5);
  for (const float loudness : {0.3F, 0.0F}) {
    std::uniform_real_distribution<float> noise(-1, 1);
    for (float& sample : dance.samples) sample = loudness * noise(random);
    EXPECT_TRUE(Perform(*queue, dance).beats.empty()) << loudness;
  }
}

// So do beats that a client predicts from the music, but not those that it knows.
TEST(MusicBeats, StopAPeriodAfterTheMusic) {
  std::vector<float> samples = Drum(36, 0.5);
  std::fill(samples.begin() + 12 * 22050 + 11025, samples.begin() + 18 * 22050, 0.0F);
  AudioFeed feed(22050, 1, 0);
  feed.Push(samples, 0, [] {});
  feed.Finish();
  std::vector<double> by_client;
  for (double beat = 0.5; beat < 38; beat += 0.5) by_client.push_back(beat);
  enum class Who { kServer, kClient, kGiven };
  for (const Who who : {Who::kServer, Who::kClient, Who::kGiven}) {
    DanceMusic music(model, {}, kDefaultDynamics, &feed);
    BeatSchedule schedule(30, &feed, std::nullopt);
    if (who == Who::kClient) music.GiveBeats(by_client, 0, "beats", {}, 0.7);
    if (who == Who::kGiven) music.GiveBeats(by_client, 0, "beats");
    std::vector<Beat> beats;
    for (int64_t from = 0; from < 36 * 30; from += 60) {
      Begin(&music, &schedule, from, from + 60);
      for (int64_t frame = from; frame < from + 60; ++frame)
        std::ranges::copy(schedule.TakeAt(frame), std::back_inserter(beats));
    }
    int silent = 0;
    for (const Beat& beat : beats) {
      silent += beat.time_s > 13.1 && beat.time_s < 17.9 ? 1 : 0;
      EXPECT_EQ(beat.source == Beat::Source::kGiven, who == Who::kGiven);
      if (who == Who::kClient) {
        EXPECT_EQ(beat.confidence, 0.7);
      }
    }
    EXPECT_EQ(silent, who == Who::kGiven ? 9 : 0);
    EXPECT_GT(std::ranges::count_if(beats, [](const Beat& b) { return b.time_s > 11; }), 8);
    EXPECT_GT(beats.back().time_s, 35);
  }
}

TEST(MusicBeats, OfAWholeSongAreAsSureAsTheyWereFound) {
  DanceMusic music(model, {}, kDefaultDynamics, nullptr);
  BeatSchedule schedule(30, nullptr, std::nullopt);
  music.SetWhole({.beats = {0.5, 1}, .downbeats = {1}, .confidence = {0.8, 0.9}});
  Begin(&music, &schedule, 0, 60);
  std::vector<Beat> beats;
  for (int64_t frame = 0; frame < 60; ++frame)
    std::ranges::copy(schedule.TakeAt(frame), std::back_inserter(beats));
  ASSERT_EQ(beats.size(), 2U);
  EXPECT_EQ(beats[0].source, Beat::Source::kFound);
  EXPECT_EQ(beats[0].confidence, 0.8);
  EXPECT_EQ(beats[1].confidence, 0.9);
  EXPECT_TRUE(beats[1].downbeat);
}

// Neither the chunks of the music nor their time of arrival change the beats.
TEST(MusicBeats, ArePureInTheSamples) {
  const auto queue = QueueOf<FakeSampler>();
  Dance dance = LiveDance(44, 16);
  const Recording expected = Perform(*queue, dance);
  for (const int64_t chunk : {735, 10'007, 1'000'000}) {
    auto sink = std::make_shared<Recorder>();
    DanceStream stream(*queue, Checked(*queue, dance.config), sink);
    for (const Key& key : dance.keys) SendKey(stream, key);
    stream.KeysComplete();
    const auto samples = static_cast<int64_t>(dance.samples.size());
    for (int64_t at = 0; at < samples; at += chunk) {
      const int64_t end = std::min(samples, at + chunk);
      stream.PushAudio(
          std::span(dance.samples).subspan(static_cast<size_t>(at), static_cast<size_t>(end - at)),
          at);
      // Each piece is danced before the next one arrives.
      const int64_t frames = (end - 1024) / 735;
      if (frames > 0) sink->WaitForFrames(static_cast<size_t>(frames));
    }
    stream.EndOfAudio();
    const Recording recording = sink->WaitForEnd();
    EXPECT_TRUE(SameDance(expected, recording)) << chunk;
    ASSERT_EQ(recording.beats.size(), expected.beats.size()) << chunk;
    for (size_t i = 0; i < expected.beats.size(); ++i)
      EXPECT_EQ(recording.beats[i].time_s, expected.beats[i].time_s);
  }
}

// Beats of a DJ's program take precedence over detected ones.
TEST(MusicBeats, MayBeGivenDuringTheDance) {
  const auto queue = QueueOf<FakeSampler>();
  Dance dance = LiveDance(45, 16);
  dance.config.generate_until = 0;
  const auto play = [&](const DanceConfig& config, bool patient) {
    auto sink = std::make_shared<Recorder>();
    DanceStream stream(*queue, Checked(*queue, config), sink);
    SendSong(stream, dance, config.audio->first_sample);
    for (int64_t frame = 30; frame <= 450; frame += 30) {
      stream.GenerateUntil(frame);
      const int64_t due = frame - config.FirstFrame();
      if (patient && due > 0) sink->WaitForFrames(static_cast<size_t>(due));
      // Beats a third of a second behind the music's; the first two come too late.
      if (frame == 240)
        stream.GiveBeats({7.3, 7.8, 8.3, 8.8, 9.3, 9.8, 10.3, 10.8, 11.3}, {7.3, 9.3, 11.3});
    }
    stream.HalfClose();
    return sink->WaitForEnd();
  };
  const Recording recording = play(dance.config, true);
  ASSERT_TRUE(recording.summary);
  ASSERT_EQ(recording.warnings.size(), 1U);
  EXPECT_EQ(recording.warnings[0].code, Warning::Code::kBeatsTooLate);
  EXPECT_EQ(recording.warnings[0].frame, 219);
  std::vector<double> given, downbeats;
  double heard_after = 0;
  for (const Beat& beat : recording.beats) {
    const bool is_given = beat.source == Beat::Source::kGiven;
    if (is_given) given.push_back(beat.time_s);
    if (is_given && beat.downbeat) downbeats.push_back(beat.time_s);
    if (!is_given && !given.empty()) heard_after = beat.time_s;
  }
  EXPECT_EQ(given, (std::vector<double>{8.3, 8.8, 9.3, 9.8, 10.3, 10.8, 11.3}));
  EXPECT_EQ(downbeats, (std::vector<double>{9.3, 11.3}));
  EXPECT_GT(heard_after, 14) << "after the last one it listens again";
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
  const auto queue = FakeQueue();
  DanceStream stream(*queue, Checked(*queue, LiveDance(46, 1).config),
                     std::make_shared<Recorder>());
  ExpectError(ErrorCode::kInvalidArgument, "beats: empty", [&] { stream.GiveBeats({}); });
  ExpectError(ErrorCode::kInvalidArgument, "beats[1]", [&] { stream.GiveBeats({2, 1}); });
  ExpectError(ErrorCode::kInvalidArgument, "downbeats[0]", [&] {
    stream.GiveBeats({1, 2}, {1.5});
  });
  std::vector<double> many;
  for (size_t i = 0; i < kMaxBeats; ++i) many.push_back(0.05 * static_cast<double>(i));
  stream.GiveBeats(many);
  ExpectError(ErrorCode::kInvalidArgument, "beats", [&] { stream.GiveBeats({1}); });
  stream.KeysComplete();
  ExpectError(ErrorCode::kInvalidArgument, "beats", [&] { stream.GiveBeats({1}); });
}

// At any tempo, and for any division into transitions, also partly danced ones, and on boundaries.
TEST(MusicBeats, AreReportedOnce) {
  for (int bpm = 60; bpm <= 145; bpm += 5) {
    const double period = 60.0 / bpm;
    AudioFeed feed(22050, 1, 0);
    feed.Push(Drum(30, period), 0, [] {});
    feed.Finish();
    for (const bool cut : {false, true}) {
      SCOPED_TRACE(std::to_string(bpm) + (cut ? ", cut" : ", whole"));
      std::mt19937 random(static_cast<uint32_t>(bpm));
      DanceMusic music(model, {}, kDefaultDynamics, &feed);
      BeatSchedule schedule(30, &feed, std::nullopt);
      for (int64_t from = 0, to = 0; from < 900; from = to) {
        const int64_t frames = cut ? 1 + static_cast<int64_t>(random() % 100) : 60;
        to = from + (cut ? 1 + static_cast<int64_t>(random()) % frames : frames);
        Begin(&music, &schedule, from, from + frames);
        for (int64_t frame = from; frame < to; ++frame) schedule.TakeAt(frame);
      }
      std::vector<double> told = schedule.reported();
      std::erase_if(told, [](double second) { return second < 8; });
      ASSERT_GT(told.size(), 16U);
      for (size_t i = 1; i < told.size(); ++i)
        EXPECT_NEAR(told[i] - told[i - 1], period, 0.1 * period) << "before " << told[i];
    }
  }
}

// Before the first given beat and after the last: beats given ahead suppress none before them. A
// program that repeats its grid, each time a few milliseconds off, as a MIDI clock arrives, means
// the same beats.
TEST(MusicBeats, RepeatedGridIsReportedOnce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.005, 0.005);
  for (const int64_t lead : {0, 6, 20}) {
    DanceMusic beats(model, {}, kDefaultDynamics, nullptr);
    BeatSchedule schedule(30, nullptr, std::nullopt);
    std::vector<Beat> told;
    for (int64_t from = 0; from < 600; from += 9) {
      std::vector<double> grid;
      const double off = jitter(random);
      for (int beat = 1; beat < 40; ++beat) {
        if (0.5 * beat > static_cast<double>(from) / 30) grid.push_back(0.5 * beat + off);
      }
      if (!grid.empty()) beats.GiveBeats(grid, from + lead, "music_beats");
      Begin(&beats, &schedule, from, from + 9);
      for (int64_t frame = from; frame < from + 9; ++frame) {
        for (const Beat& beat : schedule.TakeAt(frame)) {
          told.push_back(beat);
          EXPECT_LE(beat.frame, frame) << "it has been danced";
          EXPECT_NEAR(static_cast<double>(beat.frame), 30 * beat.time_s, 1);
        }
      }
    }
    for (size_t i = 1; i < told.size(); ++i)
      EXPECT_NEAR(told[i].time_s - told[i - 1].time_s, 0.5, 0.02) << lead;
    EXPECT_NEAR(static_cast<double>(told.size()), 38, 1.1) << lead;
  }
}

TEST(MusicBeats, AreDetectedAroundGivenOnes) {
  AudioFeed feed(22050, 1, 0);
  feed.Push(Song(22050, 20), 0, [] {});
  feed.Finish();
  DanceMusic music(model, {}, kDefaultDynamics, &feed);
  BeatSchedule schedule(30, &feed, std::nullopt);
  EXPECT_EQ(music.GiveBeats(std::vector<double>{9, 11.7, 12.2, 12.7}, 284, "beats"), 1);
  EXPECT_EQ(music.GiveBeats(std::vector<double>{12.4, 12.9}, 284, "beats"), 0);
  std::vector<Beat> beats;
  for (int64_t from = 224; from < 524; from += 60) {
    Begin(&music, &schedule, from, from + 60);
    for (int64_t frame = from; frame < from + 60; ++frame)
      for (const Beat& beat : schedule.TakeAt(frame)) beats.push_back(beat);
  }
  std::vector<double> given;
  for (size_t i = 0; i < beats.size(); ++i) {
    if (beats[i].source == Beat::Source::kGiven) {
      given.push_back(beats[i].time_s);
    } else {
      EXPECT_LT(Off(beats[i].time_s), 0.07) << beats[i].time_s;
    }
    if (i == 0) continue;
    EXPECT_NEAR(beats[i].time_s - beats[i - 1].time_s, 0.5, 0.3) << beats[i].time_s;
  }
  EXPECT_EQ(given, (std::vector<double>{11.7, 12.4, 12.9})) << "12.2 gives way";
  EXPECT_LT(beats.front().time_s, 8.1);
  EXPECT_GT(beats.back().time_s, 16.5);
}

// Only the music before a transition decides its beats.
TEST(MusicBeats, LaterMusicChangesNothing) {
  std::vector<float> song = Song(22050, 20);
  const auto around = [&song] {
    AudioFeed feed(22050, 1, 0);
    feed.Push(song, 0, [] {});
    feed.Finish();
    DanceMusic music(model, {}, kDefaultDynamics, &feed);
    return BeatsAround(SecondsOf(music.PlanFor({300, 360}, 300).Hear().beats), 30, 300, 60);
  };
  const std::vector<double> heard = around();
  ASSERT_FALSE(heard.empty());
  EXPECT_LT(heard.front(), 0);
  EXPECT_GE(heard.back(), 60);
  for (size_t i = 300 * 735 + 2000; i < song.size(); ++i) song[i] = 0;
  EXPECT_EQ(around(), heard);
}

}  // namespace choreo::dance_music_test
