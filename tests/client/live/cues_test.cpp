#include "client/live/cues.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <lo/lo.h>
#include <pty.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "client/live/beat_clock.h"
#include "client/live/midi_clock.h"
#include "client/live/sound.h"
#include "tests/client/live/osc_receiver.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::live::cues_test {

TEST(Keyboard, LettersStandForPosesAndTheTerminalIsAsBefore) {
  int master = -1, terminal = -1;
  ASSERT_EQ(openpty(&master, &terminal, nullptr, nullptr, nullptr), 0);
  termios before{}, during{}, after{};
  tcgetattr(terminal, &before);
  {
    const std::unique_ptr<Cues> keyboard = ReadKeyboard(terminal, {"kick", "groove"});
    ASSERT_TRUE(keyboard);
    tcgetattr(terminal, &during);
    EXPECT_EQ(during.c_lflag & ECHO, 0U);
    EXPECT_TRUE(keyboard->Take().empty());
    ASSERT_EQ(write(master, "bz!a\x7f", 5), 5);
    std::vector<Cue> cues;
    while (cues.size() < 3) {
      for (const Cue& cue : keyboard->Take()) cues.push_back(cue);
    }
    EXPECT_EQ(cues[0].pose, "groove");
    EXPECT_EQ(cues[1].pose, "kick");
    EXPECT_EQ(cues[2].pose, "");
  }
  tcgetattr(terminal, &after);
  EXPECT_EQ(after.c_lflag, before.c_lflag);
  close(terminal);
  close(master);
}

// What arrows, function keys and Alt with a letter send; the last one in two parts.
TEST(Keyboard, ArrowsAndFunctionKeysAskForNothing) {
  int master = -1, terminal = -1;
  ASSERT_EQ(openpty(&master, &terminal, nullptr, nullptr, nullptr), 0);
  const std::unique_ptr<Cues> keyboard =
      ReadKeyboard(terminal, std::vector<std::string>(KeyboardKeys().size(), "pose"));
  std::vector<Cue> cues;
  const auto type = [&](const std::string& keys, const char* last) {
    ASSERT_EQ(write(master, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
    const size_t before = cues.size();
    // Until the last key, a backspace, has come.
    while (cues.size() == before || std::string(last) != cues.back().pose) {
      for (const Cue& cue : keyboard->Take()) cues.push_back(cue);
    }
  };
  type(
      "\x1b[A\x1b[1;5C\x1bOP\x1b[15~\x1b"
      "a\x7f",
      "");
  EXPECT_EQ(cues.size(), 1U);
  type("\x1b[Da\x7f", "");
  ASSERT_EQ(cues.size(), 3U);
  EXPECT_EQ(cues[1].pose, "pose");
  // The escape key alone, and a letter later.
  ASSERT_EQ(write(master, "\x1b", 1), 1);
  for (int i = 0; i < 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_TRUE(keyboard->Take().empty());
  }
  type("a", "pose");
  EXPECT_EQ(cues.size(), 4U);
  close(terminal);
  close(master);
}

TEST(Keyboard, IsAbsentWithoutATerminal) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  EXPECT_FALSE(ReadKeyboard(ends[0], {"kick"}));
  close(ends[0]);
  close(ends[1]);
}

TEST(OscCues, SecondsAreANumberOfAnyType) {
  const int port = OscReceiver().port();
  const std::unique_ptr<Cues> cues = HearOsc(port);
  const std::unique_ptr<void, void (*)(lo_address)> to(
      lo_address_new("127.0.0.1", std::to_string(port).c_str()), lo_address_free);
  lo_send(to.get(), "/choreo/key", "si", "kick", 2);
  lo_send(to.get(), "/choreo/key", "sd", "kick", 2.5);
  lo_send(to.get(), "/choreo/key", "sf", "kick", NAN);
  lo_send(to.get(), "/choreo/key", "ss", "kick", "2");
  lo_send(to.get(), "/choreo/undo", "");
  std::vector<Cue> came;
  while (came.empty() || !came.back().pose.empty()) {
    for (Cue& cue : cues->Take()) came.push_back(std::move(cue));
  }
  ASSERT_EQ(came.size(), 4U);
  EXPECT_TRUE(std::isnan(*came[2].ahead_s)) << "who takes it says so";
  EXPECT_EQ(came[0].ahead_s, 2);
  EXPECT_EQ(came[1].ahead_s, 2.5);
}

TEST(BeatClock, ContinuesFromPastBeats) {
  BeatClock clock;
  EXPECT_EQ(clock.AtOrAfter(1.3, 0.3), 1.3);
  for (const double second : {1.0, 1.5, 2.02, 2.5})
    clock.Hear({.time_s = second, .confidence = 0.6});
  ASSERT_TRUE(clock.Period(2.6));
  EXPECT_NEAR(*clock.Period(2.6), 0.5, 1e-9);
  EXPECT_EQ(clock.confidence(), 0.6);
  EXPECT_NEAR(clock.AtOrAfter(3.6, 2.6), 4.0, 1e-9);
  EXPECT_NEAR(clock.AtOrAfter(4.0, 2.6), 4.0, 1e-9);
  EXPECT_NEAR(clock.AtOrAfter(4.01, 2.6), 4.5, 1e-9);
  // The music has paused.
  EXPECT_FALSE(clock.Period(6));
  EXPECT_EQ(clock.AtOrAfter(7, 6), 7);
}

TEST(BeatClock, IgnoresBeatsBeforeAGap) {
  BeatClock clock;
  for (const double second : {1.0, 1.5, 2.0, 5.1, 5.5}) clock.Hear({.time_s = second});
  EXPECT_FALSE(clock.Period(5.6));  // two beats of the new pulse
  clock.Hear({.time_s = 5.9});
  ASSERT_TRUE(clock.Period(6));
  EXPECT_NEAR(*clock.Period(6), 0.4, 1e-9);
}

TEST(BeatClock, InitialGapIsNoPulse) {
  BeatClock clock;
  for (const double second : {1.0, 3.2, 3.7}) clock.Hear({.time_s = second});
  ASSERT_TRUE(clock.Period(3.8));
  EXPECT_NEAR(*clock.Period(3.8), 0.5, 1e-9);
}

// 24 ticks a beat at 125 a minute, read piece by piece.
TEST(MidiClock, PredictsBeatsAfterItsStart) {
  const TemporaryFolder folder;
  const std::string device = folder / "midi";
  ASSERT_EQ(mkfifo(device.c_str(), 0600), 0);
  MidiClock clock(device);
  const int out = open(device.c_str(), O_WRONLY);
  const auto say = [&](uint8_t byte) { ASSERT_EQ(write(out, &byte, 1), 1); };
  constexpr double kBeat = 0.48, kStart = 1.013;
  int ticks = -30, told = 0;  // some before the start say nothing
  for (double now = kPieceSeconds; now < 8; now += kPieceSeconds) {
    for (; kStart + ticks * kBeat / 24 < now; ++ticks) {
      if (ticks == 0) say(0xFA);
      say(0x90);  // a note, which is none of ours
      say(0xF8);
    }
    const std::vector<double> beats = clock.Take(now);
    if (beats.empty()) continue;
    ++told;
    EXPECT_GE(beats.size(), 7U);
    for (const double beat : beats) {
      const double turns = (beat - kStart) / kBeat;
      EXPECT_LT(std::abs(turns - std::round(turns)) * kBeat, 0.01) << beat;
      EXPECT_GT(beat, now);
    }
  }
  EXPECT_EQ(told, 6);
  say(0xFC);
  for (int i = 0; i < 100; ++i) say(0xF8);
  EXPECT_TRUE(clock.Take(8.1).empty());
  close(out);
}

TEST(MidiClock, NamesAMissingDevice) {
  ExpectError(ErrorCode::kNotFound, "--midi-clock: \"/no/midi\"", [] { MidiClock("/no/midi"); });
}

TEST(MidiClock, FilesAndFoldersAreNoDevices) {
  const TemporaryFolder folder;
  std::ofstream(folder / "song.mid") << "MThd";
  const std::string file = folder / "song.mid", own = folder.path();
  ExpectError(ErrorCode::kInvalidArgument, "--midi-clock: \"" + file + "\" is a file",
              [&] { MidiClock{file}; });
  ExpectError(ErrorCode::kInvalidArgument, "--midi-clock: \"" + own + "\" is a folder",
              [&] { MidiClock{own}; });
}

TEST(MidiClock, RefusesAnEndlessDevice) {
  MidiClock clock("/dev/zero");
  ExpectError(ErrorCode::kInvalidArgument, "--midi-clock: \"/dev/zero\" is not a MIDI device",
              [&] { clock.Take(1); });
}

TEST(MidiClock, RunsFromItsStartOn) {
  const TemporaryFolder folder;
  const std::string device = folder / "midi";
  ASSERT_EQ(mkfifo(device.c_str(), 0600), 0);
  MidiClock clock(device);
  const int out = open(device.c_str(), O_WRONLY);
  ASSERT_EQ(write(out, "\xf8", 1), 1);
  clock.Take(1);
  EXPECT_FALSE(clock.runs());
  ASSERT_EQ(write(out, "\xfa\xf8", 2), 2);
  clock.Take(2);
  EXPECT_TRUE(clock.runs());
  close(out);
}

// ALSA's own device that plays a file to a recorder.
TEST(LineIn, ReadsTheDevicesSamples) {
  const TemporaryFolder folder;
  std::vector<float> played(44100);
  for (size_t i = 0; i < played.size(); ++i) played[i] = static_cast<float>(i) / 44100;
  std::ofstream(folder / "played.raw", std::ios::binary)
      .write(reinterpret_cast<const char*>(played.data()),
             static_cast<std::streamsize>(played.size() * sizeof(float)));
  std::ofstream(folder / "alsa.conf")
      << "pcm.nothing { type null }\n"
      << "pcm.deck { type file slave.pcm nothing file /dev/null format raw infile " << '"'
      << (folder / "played.raw").string() << "\" }\n";
  setenv("ALSA_CONFIG_PATH", (folder / "alsa.conf").c_str(), 1);
  const std::unique_ptr<Sound> sound = ListenTo("deck");
  EXPECT_EQ(sound->sample_rate(), 44100);
  EXPECT_EQ(sound->channels(), 1);
  std::vector<float> heard;
  while (heard.size() < played.size()) {
    const std::span<const float> piece = sound->Next();
    ASSERT_FALSE(piece.empty());
    heard.insert(heard.end(), piece.begin(), piece.end());
  }
  heard.resize(played.size());
  EXPECT_EQ(heard, played);
  unsetenv("ALSA_CONFIG_PATH");
}

}  // namespace choreo::live::cues_test
