#include "client/authoring/music/beat_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include "client/authoring/music/music.h"
#include "client/authoring/notes/notes.h"
#include "client/authoring/project/project_file.h"
#include "model/audio/beats/onset.h"
#include "model/audio/signal/format.h"
#include "tests/support/expect_error.h"
#include "tests/support/music_files.h"
#include "tests/support/temporary_folder.h"

// Beats that a choreographer gives, and corrections of those that are found.
namespace choreo::authoring::music_beats_test {

using testing::DoubleNear;
using testing::ElementsAre;

class MusicBeats : public testing::Test {
 protected:
  /// The beats of a song of ten seconds without detected beats.
  BeatTrack Read(const std::string& lines, BeatOptions options = {}, double start = 0) {
    const std::filesystem::path file = folder_ / "beats.txt";
    std::ofstream(file) << lines;
    options.beats = file.string();
    const std::vector<Onset> silence(static_cast<size_t>(10 * kModelSampleRate / kOnsetHop));
    return BeatsAsAsked(silence, start, options);
  }

  TemporaryFolder folder_;
};

/// The lines that `work` notes.
std::string Noted(const std::function<void()>& work) {
  const NotesApart notes;
  work();
  std::string noted;
  for (const std::string& line : notes.lines()) noted += line;
  return noted;
}

testing::Matcher<double> Near(double seconds) {
  return DoubleNear(seconds, 0.5 * kOnsetHop / kModelSampleRate);
}

TEST_F(MusicBeats, AreReadWithCountsFromAFile) {
  const BeatTrack track = Read("0.5 3\n\n1.0 1  # the first bar\n1.5 2\n2.0 3\n");
  EXPECT_THAT(track.Seconds(), ElementsAre(Near(0.5), Near(1), Near(1.5), Near(2)));
  EXPECT_THAT(track.DownbeatSeconds(), ElementsAre(Near(1)));
  EXPECT_EQ(track.beats_in_bar, 3);
  EXPECT_NEAR(track.tempo_bpm, 120, 1);
}

TEST_F(MusicBeats, WithoutCountsAreCountedInFours) {
  const BeatTrack track = Read("1\n2\n3\n4\n5\n6\n");
  EXPECT_THAT(track.DownbeatSeconds(), ElementsAre(Near(1), Near(5)));
}

TEST_F(MusicBeats, SecondsCountFromTheDancesStart) {
  EXPECT_THAT(Read("1\n2\n3\n", {}, 1.5).Seconds(), ElementsAre(Near(0.5), Near(1.5)));
}

TEST_F(MusicBeats, HalfTimeKeepsDownbeats) {
  const BeatTrack track = Read("1 4\n2 1\n3 2\n4 3\n5 4\n6 1\n", {.hint = {.half_time = true}});
  EXPECT_THAT(track.Seconds(), ElementsAre(Near(2), Near(4), Near(6)));
  EXPECT_THAT(track.DownbeatSeconds(), ElementsAre(Near(2)));
}

TEST_F(MusicBeats, DoubleTimeAddsOneBetweenTwo) {
  const BeatTrack track = Read("1\n2\n3\n", {.hint = {.double_time = true}});
  EXPECT_THAT(track.Seconds(), ElementsAre(Near(1), Near(1.5), Near(2), Near(2.5), Near(3)));
}

// At high tempi one row more or less is much of a beat.
TEST_F(MusicBeats, TheTempoIsThatOfTheBeatsWithEveryHint) {
  for (int bpm = 50; bpm <= 400; bpm += 7) {
    std::string lines;
    for (double second = 0; second < 10; second += 60.0 / bpm)
      lines += std::to_string(second) + "\n";
    for (const BeatHint& hint :
         {BeatHint(), BeatHint{.half_time = true}, BeatHint{.double_time = true}}) {
      const double times = hint.half_time ? 0.5 : hint.double_time ? 2 : 1;
      EXPECT_NEAR(Read(lines, {.hint = hint}).tempo_bpm, times * bpm, 0.008 * times * bpm) << bpm;
    }
  }
}

// A pause, and a hole where a beat is missing.
TEST_F(MusicBeats, DoubleTimeAddsNoneInPauses) {
  const BeatTrack track =
      Read("1\n1.4\n1.8\n2.6\n3\n3.4\n8\n8.4\n", {.hint = {.double_time = true}});
  EXPECT_THAT(track.Seconds(),
              ElementsAre(Near(1), Near(1.2), Near(1.4), Near(1.6), Near(1.8), Near(2.6), Near(2.8),
                          Near(3), Near(3.2), Near(3.4), Near(8), Near(8.2), Near(8.4)));
}

TEST_F(MusicBeats, DoubleTimeFollowsAnotherTempo) {
  const BeatTrack track =
      Read("0\n0.5\n1\n1.5\n2\n2.5\n3\n4\n5\n6\n7\n8\n9\n", {.hint = {.double_time = true}});
  EXPECT_EQ(track.frames.size(), 25U);
}

TEST_F(MusicBeats, HalfTimeKeepsDownbeatsAfterAPause) {
  const BeatTrack track = Read("1 1\n1.5 2\n2 3\n2.5 4\n3 1\n6 4\n6.5 1\n7 2\n7.5 3\n8 4\n",
                               {.hint = {.half_time = true}});
  EXPECT_THAT(track.Seconds(), ElementsAre(Near(1), Near(2), Near(3), Near(6.5), Near(7.5)));
  EXPECT_THAT(track.DownbeatSeconds(), ElementsAre(Near(1), Near(6.5)));
}

// A pause of six beats, and then another bar.
TEST_F(MusicBeats, ADownbeatLeavesBarsBeyondAPauseWhereTheyBegan) {
  const std::string counted =
      "0.2 1\n0.7 2\n1.2 3\n1.7 4\n2.2 1\n5.2 1\n5.7 2\n6.2 3\n6.7 4\n7.2 1\n";
  EXPECT_THAT(Read(counted, {.downbeat_s = 2.2}).DownbeatSeconds(),
              ElementsAre(Near(0.2), Near(2.2), Near(5.2), Near(7.2)));
  EXPECT_THAT(Read(counted, {.downbeat_s = 1.2}).DownbeatSeconds(),
              ElementsAre(Near(1.2), Near(6.2)));
}

TEST_F(MusicBeats, WithoutCountsTheCountGoesOnByTimeInAPause) {
  const BeatTrack track = Read("0.2\n0.7\n1.2\n1.7\n2.2\n5.2\n5.7\n6.2\n6.7\n7.2\n");
  EXPECT_THAT(track.DownbeatSeconds(), ElementsAre(Near(0.2), Near(2.2), Near(6.2)));
}

TEST_F(MusicBeats, CountsFromTheChosenDownbeat) {
  const BeatTrack track = Read("1\n2\n3\n4\n5\n6\n", {.downbeat_s = 2.9});
  EXPECT_THAT(track.DownbeatSeconds(), ElementsAre(Near(3)));
}

// The dance begins after it: at 3.5 s, with beat 4, the fourth of the bar from 1 on.
TEST_F(MusicBeats, CountsFromADownbeatBeforeTheDance) {
  const BeatTrack track = Read("1\n2\n3\n4\n5\n6\n7\n8\n9\n", {.downbeat_s = 1}, 3.5);
  EXPECT_THAT(track.DownbeatSeconds(), ElementsAre(Near(1.5), Near(5.5)));
}

TEST_F(MusicBeats, CountsFromGivenDownbeats) {
  const BeatTrack track = Read("0.5 1\n1\n1.5\n2 1\n2.5\n3\n");
  EXPECT_EQ(track.beats_in_bar, 3);
  EXPECT_THAT(track.DownbeatSeconds(), ElementsAre(Near(0.5), Near(2)));
}

TEST_F(MusicBeats, BadLinesAreRefusedByTheirNumber) {
  ExpectError(ErrorCode::kInvalidArgument, "beats.txt:2", [&] { Read("1\ntwo\n"); });
  ExpectError(ErrorCode::kInvalidArgument, "beats.txt:2", [&] { Read("2\n1\n"); });
  ExpectError(ErrorCode::kInvalidArgument, "1 to 16", [&] { Read("1 17\n"); });
  ExpectError(ErrorCode::kInvalidArgument, "beats: ", [&] { Read("# none\n"); });
  ExpectError(ErrorCode::kInvalidArgument, "beats.txt: has no beat after second 5",
              [&] { Read("1\n2\n", {}, 5); });
  for (const char* bad : {"1 2x\n", "1 2 3\n", "0,5\n", "nan\n", "1e300\n", "-1\n"})
    ExpectError(ErrorCode::kInvalidArgument, "beats.txt:1", [&] { Read(bad); });
  ExpectError(ErrorCode::kInvalidArgument,
              "is 0.01 s after the beat before it, must be 1/90 s or more",
              [&] { Read("0.01\n0.02\n"); });
  ExpectError(ErrorCode::kInvalidArgument, "too long", [&] { Read(std::string(5000, '1')); });
  ExpectError(ErrorCode::kInvalidArgument, "beats are in seconds", [&] { Read("500\n1000\n"); });
  ExpectError(ErrorCode::kInvalidArgument,
              "downbeat: 500 s is after the part of the song that is heard, its first",
              [&] { Read("1\n", {.downbeat_s = 500}); });
}

TEST_F(MusicBeats, KnownOnesAreChangedAsTheOptionsSay) {
  const std::vector<double> beats{0.503, 1.001, 1.507, 2.002, 2.503, 3.004},
      downbeats{1.001, 2.503};
  const auto changed = [&](const BeatOptions& options, double start = 0) {
    auto result = std::pair(beats, downbeats);
    ChangeBeats(options, start, &result.first, &result.second);
    return result;
  };
  EXPECT_EQ(changed({.beats = "auto", .hint = {.tempo_bpm = 120}}), std::pair(beats, downbeats));
  const auto half = changed({.hint = {.half_time = true}});
  EXPECT_EQ(half.first, (std::vector<double>{1.001, 2.002, 3.004})) << "exactly, with the downbeat";
  EXPECT_EQ(half.second, (std::vector<double>{1.001}));
  const auto twice = changed({.hint = {.double_time = true}});
  EXPECT_EQ(twice.first.size(), 11U);
  EXPECT_NEAR(twice.first[1], 0.752, 0.01);
  // The dance begins half a second into the song.
  const auto counted = changed({.downbeat_s = 2.1}, 0.5);
  EXPECT_EQ(counted.first, beats);
  EXPECT_EQ(counted.second, (std::vector<double>{1.507, 3.004}));
}

// A song of even strokes whose bass begins late, and tells where bars begin.
TEST_F(MusicBeats, AreThoseOfTheWholeSongHoweverMuchIsDanced) {
  std::vector<float> samples(60 * kModelSampleRate);
  const auto strike = [&](double second, double loudness, double hertz) {
    const auto begin = static_cast<size_t>(second * kModelSampleRate);
    for (size_t i = 0; i < kModelSampleRate / 12; ++i) {
      const double t = static_cast<double>(i) / kModelSampleRate;
      samples[begin + i] += static_cast<float>(loudness * std::exp(-40 * t) *
                                               std::sin(2 * std::numbers::pi * hertz * t));
    }
  };
  for (int i = 0; i < 119; ++i) {
    strike(0.5 * i, 0.3, 1000);
    if (i > 48 && i % 4 == 2) strike(0.5 * i, 0.6, 60);
  }
  WriteWav(folder_ / "song.wav", samples);
  Music whole = ReadMusic(folder_ / "song.wav"), part = ReadMusic(folder_ / "song.wav", 8);
  EXPECT_NEAR(part.audio.seconds(), 8.5, 0.01);
  EXPECT_EQ(AudioFor(part.audio, 8).samples, AudioFor(whole.audio, 8).samples);
  EXPECT_EQ(part.id, whole.id);
  for (Music* music : {&whole, &part}) KeepFirst(8, music);
  EXPECT_GE(part.track.frames.size(), 14U);
  EXPECT_EQ(part.track.frames, whole.track.frames);
  EXPECT_EQ(part.track.in_bar, whole.track.in_bar);
}

// It is refused only where so much of it is asked for.
TEST_F(MusicBeats, OfASongThatIsTooLongAreFoundInItsFirstTenMinutes) {
  WriteWav(folder_ / "song.wav", std::vector<float>(620 * size_t{kModelSampleRate}));
  EXPECT_NEAR(ReadMusic(folder_ / "song.wav", 8).audio.seconds(), 8.5, 0.01);
  EXPECT_EQ(ReadMusic(folder_ / "song.wav", 8).mono.size(), 600 * size_t{kModelSampleRate});
  ExpectError(ErrorCode::kInvalidArgument, "choose a part of it",
              [&] { ReadMusic(folder_ / "song.wav", 610); });
}

TEST_F(MusicBeats, ATempoThatTheMusicDoesNotHaveIsWarnedOf) {
  std::vector<Onset> onsets(static_cast<size_t>(30 * kOnsetRate));  // at 120 bpm
  for (size_t i = 0; i < onsets.size(); i += 45) {
    onsets[i].rise = {8, 8, 8};
    for (size_t k = i; k < std::min(i + 45, onsets.size()); ++k) onsets[k].loud_db = -10;
  }
  const auto said = [&](double tempo) {
    return Noted([&] { BeatsAsAsked(onsets, 0, {.hint = {.tempo_bpm = tempo}}); });
  };
  EXPECT_THAT(said(97),
              testing::StartsWith("warning: --tempo 97 is far from the tempo heard, 120 "));
  for (const double tempo : {120.0, 123.0, 60.0, 80.0, 180.0}) EXPECT_EQ(said(tempo), "") << tempo;
  // It might be two thirds of the music's, but nothing is found so near to it.
  EXPECT_EQ(said(170), "warning: --tempo 170 is not found; beats are taken at 160 a minute");
}

TEST_F(MusicBeats, ADownbeatFarFromAnyBeatIsWarnedOf) {
  const auto said = [&](double downbeat) {
    return Noted([&] { Read("1\n1.5\n2\n2.5\n", {.downbeat_s = downbeat}, 0.5); });
  };
  EXPECT_THAT(said(8), testing::StartsWith("warning: --downbeat 8 is more than a beat away from "
                                           "any beat; the nearest, at 2.5 s, begins a bar"));
  for (const double near : {0.1, 0.6, 1.7, 2.9}) EXPECT_EQ(said(near), "") << near;
}

TEST_F(MusicBeats, OptionsForWhichThereAreTooFewAreWarnedOf) {
  const std::vector<Onset> silence(900);
  const auto silent = [&](const BeatOptions& options) {
    return Noted([&] { BeatsAsAsked(silence, 0, options); });
  };
  EXPECT_EQ(silent({.downbeat_s = 3}), "warning: --downbeat 3 changes nothing: no beat is heard");
  EXPECT_EQ(silent({.hint = {.half_time = true}}),
            "warning: --half-time changes nothing: no beat is heard");
  EXPECT_EQ(silent({.hint = {.tempo_bpm = 120}}), "warning: --tempo 120 finds no beat");
  EXPECT_EQ(silent({}), "");
  EXPECT_EQ(Noted([&] { Read("1\n", {.hint = {.double_time = true}}); }),
            "warning: --double-time changes nothing: there is only one beat");
  EXPECT_EQ(Noted([&] { Read("1\n", {.downbeat_s = 1}); }), "");
}

TEST_F(MusicBeats, ThoseBehindTheSongsEndAreToldOf) {
  const std::string lines = "1\n2\n3\n9\n10\n11\n12.5\n";
  const auto said = Noted([&] { EXPECT_EQ(Read(lines).frames.size(), 5U); });
  EXPECT_THAT(said, testing::EndsWith(
                        "beats.txt: 2 beats are left out, behind the end of the song at 10 s"));
  EXPECT_THAT(Noted([&] { Read(lines, {}, 2); }),
              testing::EndsWith("1 beat is left out, behind the end of the song at 12 s"));
  EXPECT_EQ(Noted([&] { Read("1\n2\n10\n"); }), "");
}

// Not with the last row of onsets, which ends later.
TEST_F(MusicBeats, ASongEndsWithItsLastSample) {
  const std::vector<float> song(20 * size_t{kModelSampleRate});
  ExpectError(ErrorCode::kInvalidArgument, "its first 20 s",
              [&] { BeatsAsAsked(FindOnsets(song), 0, {.downbeat_s = 30}, song); });
}

TEST_F(MusicBeats, AutoNeedsNoSong) {
  RequireSong({.beats = "auto"}, "");
  ExpectError(ErrorCode::kInvalidArgument, "need a song",
              [] { RequireSong({.hint = {.half_time = true}}, ""); });
}

// As a beat file's.
TEST_F(MusicBeats, AProjectsAreCheckedAsThoseOfAFile) {
  const auto project = [](const std::string& beats) {
    return ParseProject(
        nlohmann::json::parse(R"({"studio": 1, "keyframes": [], "beats": )" + beats + "}"),
        "p.json");
  };
  ExpectError(ErrorCode::kInvalidArgument,
              "p.json:beats[1]: is 0.005 s after the beat before it, must be 1/90 s or more",
              [&] { project("[[0.5, 1], [0.505, 2]]"); });
  ExpectError(ErrorCode::kInvalidArgument, "p.json:beats: need a song",
              [&] { RequireSong(project("[[1, 1]]"), "", "p.json"); });
  RequireSong(project("[]"), "", "p.json");
  RequireSong(project("[[1, 1]]"), "song.wav", "p.json");
}

TEST_F(MusicBeats, InSecondsOfADanceEndWithItsSong) {
  const auto note = [](const std::vector<double>& beats) {
    return Noted([&] { NoteBehind("p.json:beats", beats, 2, 10); });
  };
  EXPECT_EQ(note({1, 10, 10.5, 11}),
            "note: p.json:beats: 2 beats are left out, behind the end of the song at 12 s");
  EXPECT_EQ(note({}), "");
  ExpectError(ErrorCode::kInvalidArgument,
              "p.json:beats: has no beat within the part of the song that is heard, its first 12 s",
              [&] {
                note({100, 101});
              });
}

// The server hears of them as far as the dance goes.
TEST_F(MusicBeats, AProjectsCountsSayWhichBeatsBeginABar) {
  const auto file = nlohmann::json::parse(R"({"studio": 1, "keyframes": [{"id": "a"}], "bar": 3,
    "beats": [[0.5, 6], [1, 1], [1.5, 2], [2, 3], [2.5, 4], [4, 1]]})");
  const Project project = ParseProject(file, "p.json");
  EXPECT_THAT(project.downbeats, ElementsAre(1, 2.5, 4));
  KnownMusic known{.music_beats = project.beats, .music_downbeats = project.downbeats};
  FillInMusic({}, 3, &known);
  EXPECT_THAT(known.music_beats, ElementsAre(0.5, 1, 1.5, 2, 2.5));
  EXPECT_THAT(known.music_downbeats, ElementsAre(1, 2.5));
}

}  // namespace choreo::authoring::music_beats_test
