// The table of docs/song.md, made out of files that ffmpeg writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "client/authoring/music/decode_song.h"
#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace choreo::cli::sound_table_test {

struct Codec {
  const char* name;
  const char* encoder;
};
struct Container {
  const char* extension;
  std::vector<Codec> codecs;
};

const std::vector<Container>& Containers() {
  static const std::vector<Container> all = {
      {".wav",
       {{"PCM", "pcm_s16le"},
        {"float", "pcm_f32le"},
        {"µ-law", "pcm_mulaw"},
        {"A-law", "pcm_alaw"},
        {"ADPCM", "adpcm_ms"},
        {"MP3", "libmp3lame"}}},
      {".flac", {{"FLAC", "flac"}}},
      {".ogg", {{"Vorbis", "libvorbis"}, {"Opus", "libopus"}, {"FLAC", "flac"}}},
      {".mp3", {{"MP3", "libmp3lame"}}},
      {".mp2", {{"MP2", "mp2"}}},
      {".m4a", {{"AAC", "aac"}, {"ALAC", "alac"}}},
      {".mp4", {{"AAC", "aac"}}},
      {".aac", {{"AAC", "aac"}}},
      {".webm", {{"Opus", "libopus"}, {"Vorbis", "libvorbis"}}},
      {".mka", {{"FLAC", "flac"}, {"MP3", "libmp3lame"}}},
      {".aiff", {{"PCM", "pcm_s16be"}}},
      {".caf", {{"ALAC", "alac"}}},
      {".wma", {{"WMA", "wmav2"}}},
      {".wv", {{"WavPack", "wavpack"}}},
  };
  return all;
}

constexpr double kSeconds = 2;
// What an encoder may add at both ends, or keep.
constexpr double kPadding = 0.1;

/// The outcome for two seconds of a tone, in the table's words.
std::string OutcomeOf(const std::filesystem::path& file) {
  const auto lasts = [](const DecodedAudio& audio) {
    EXPECT_NEAR(audio.seconds(), kSeconds, kPadding);
    double loudest = 0;
    for (const float sample : audio.interleaved)
      loudest = std::max<double>(loudest, std::abs(sample));
    // ffmpeg's sine, whose power it shares out between two channels.
    EXPECT_NEAR(loudest, 0.125 / std::sqrt(2), 0.02);
  };
  try {
    lasts(DecodeAudioFile(file));
    return "read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
    EXPECT_EQ(error.remedy(), Remedy::kConvert) << error.what();
  }
  lasts(authoring::DecodeSong(file, INFINITY, 0));
  return "by ffmpeg";
}

std::string FileOf(const Container& container, const Codec& codec) {
  return std::string(codec.encoder) + container.extension;
}

TEST(SoundTable, MatchesWhatTheClientReads) {
  if (Shell("ffmpeg -version").code != 0)
    GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  const std::string encoders = Shell("ffmpeg -hide_banner -encoders").said;
  const std::string page = ReadFile(std::filesystem::path(SOURCE_FOLDER) / "docs/song.md");
  const auto has = [&](const Codec& codec) {
    return encoders.find(std::string(" ") + codec.encoder + " ") != std::string::npos;
  };
  const TemporaryFolder folder;
  // All at once: ffmpeg takes longer to start than to write one.
  std::string make =
      "ffmpeg -nostdin -v error -y -f lavfi -i sine=330:duration=2:sample_rate=44100";
  for (const Container& container : Containers()) {
    for (const Codec& codec : container.codecs) {
      if (has(codec))
        make += " -ac 2 -c:a " + std::string(codec.encoder) + " " +
                (folder / FileOf(container, codec)).string();
    }
  }
  const Outcome made = Shell(make);
  ASSERT_EQ(made.code, 0) << made.said;
  for (const Container& container : Containers()) {
    std::string names;
    std::set<std::string> outcomes;
    for (const Codec& codec : container.codecs) {
      names += (names.empty() ? "" : ", ") + std::string(codec.name);
      if (!has(codec)) {
        std::cout << "skipped: this ffmpeg has no " << codec.encoder << '\n';
        continue;
      }
      SCOPED_TRACE(container.extension + std::string(" ") + codec.name);
      outcomes.insert(OutcomeOf(folder / FileOf(container, codec)));
    }
    if (outcomes.empty()) continue;
    ASSERT_EQ(outcomes.size(), 1U) << container.extension << ": one outcome a row";
    const std::string row = "| `" + std::string(container.extension) + "` | " + names + " | " +
                            *outcomes.begin() + " |";
    EXPECT_NE(page.find(row), std::string::npos) << "docs/song.md should say\n" << row;
  }
}

// The reason why a file can't be read.
TEST(SoundTable, ReportsFfmpegsErrors) {
  if (Shell("ffmpeg -version").code != 0)
    GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  const TemporaryFolder folder;
  const auto make = [&](const std::string& words, const char* name) {
    const Outcome made =
        Shell("ffmpeg -nostdin -v error -y " + words + " " + (folder / name).string());
    ASSERT_EQ(made.code, 0) << made.said;
  };
  make("-f lavfi -i color=size=16x16:duration=1 -c:v mpeg4", "silent.mp4");
  ExpectError(ErrorCode::kInvalidArgument, "audio, and ffmpeg finds no sound in it: ", [&] {
    authoring::DecodeSong(folder / "silent.mp4", INFINITY, 0);
  });
  // The name of a file is no reason to ask ffmpeg.
  WriteFile(folder / (std::string(kAskFfmpeg) + ".wav"), "no song");
  ExpectError(ErrorCode::kInvalidArgument, "audio but text", [&] {
    authoring::DecodeSong(folder / (std::string(kAskFfmpeg) + ".wav"), INFINITY, 0);
  });
}

void Make(const std::string& words, const std::filesystem::path& file) {
  const Outcome made = Shell("ffmpeg -nostdin -v error -y " + words + " " + file.string());
  ASSERT_EQ(made.code, 0) << made.said;
}

TEST(SoundTable, AFilmsSoundCountsFromItsBeginning) {
  if (Shell("ffmpeg -version").code != 0)
    GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "late.mkv";
  Make(
      "-itsoffset 1.5 -f lavfi -i sine=330:duration=2 -f lavfi -i color=size=16x16:duration=3 "
      "-map 0:a -map 1:v -c:v mpeg4 -c:a pcm_s16le",
      file);
  const DecodedAudio late = authoring::DecodeSong(file, INFINITY, 0);
  EXPECT_NEAR(late.seconds(), 3.5, kPadding);
  const auto loud = std::ranges::find_if(late.interleaved, [](float x) { return x > 0.05F; });
  EXPECT_NEAR(
      static_cast<double>(loud - late.interleaved.begin()) / late.channels / late.sample_rate, 1.5,
      0.05);
  // A note says which of two tracks is used.
  Make("-f lavfi -i sine=330:duration=1 -f lavfi -i sine=440:duration=1 -map 0 -map 1 -c:a flac",
       folder / "two.mka");
  const std::vector<std::string> notes =
      authoring::DecodeSong(folder / "two.mka", INFINITY, 0).notes;
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[1].find("has 2 sound tracks, of which ffmpeg chose one"), std::string::npos);
  // A station's rate, and number of channels, may change: each part counts once.
  Make("-f lavfi -i sine=330:duration=2:sample_rate=44100 -ac 1 -c:a libmp3lame -write_xing 0",
       folder / "mono.mp3");
  Make("-f lavfi -i sine=330:duration=3:sample_rate=48000 -ac 2 -c:a libmp3lame -write_xing 0",
       folder / "stereo.mp3");
  WriteFile(folder / "both.mp3", ReadFile(folder / "mono.mp3") + ReadFile(folder / "stereo.mp3"));
  EXPECT_NEAR(authoring::DecodeSong(folder / "both.mp3", INFINITY, 0).seconds(), 5, 1.5 * kPadding);
  // A tag may hold sound of its own.
  Make("-f lavfi -i sine=330:duration=2 -c:a libmp3lame", folder / "a.mp3");
  const std::string song = ReadFile(folder / "a.mp3"), held = song.substr(0, song.size() / 2);
  std::string tag = "ID3" + std::string(3, '\3');
  for (const int bits : {21, 14, 7, 0}) tag += static_cast<char>(held.size() >> bits & 0x7f);
  WriteFile(folder / "tagged.mp3", tag + held + song);
  EXPECT_NEAR(DecodeAudioFile(folder / "tagged.mp3").seconds(), 2, kPadding);
  // A stream for a receiver is no noise.
  Make("-f lavfi -i sine=330:duration=2 -c:a ac3 -f spdif", folder / "a.spdif");
  Make("-f s16le -ar 48000 -ac 2 -i " + (folder / "a.spdif").string(), folder / "ac3.wav");
  ExpectError(ErrorCode::kInvalidArgument, "such as AC-3",
              [&] { DecodeAudioFile(folder / "ac3.wav"); });
}

}  // namespace choreo::cli::sound_table_test
