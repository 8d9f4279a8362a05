// The table of docs/song.md, made out of files that ffmpeg writes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "client/cli/music_file.h"
#include "model/core/atomic_file.h"
#include "model/core/error.h"
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

/// What becomes of two seconds of a tone, as the table says it.
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
    EXPECT_NE(std::string(error.what()).find(kAskFfmpeg), std::string::npos) << error.what();
  }
  lasts(DecodeSong(file, INFINITY, 0));
  return "by ffmpeg";
}

TEST(SoundTable, IsWhatBecomesOfThem) {
  if (Shell("ffmpeg -version").code != 0)
    GTEST_SKIP() << "no ffmpeg here (scripts/install_packages.sh video)";
  const std::string encoders = Shell("ffmpeg -hide_banner -encoders").said;
  const std::string page = ReadFile(std::filesystem::path(SOURCE_FOLDER) / "docs/song.md");
  const TemporaryFolder folder;
  for (const Container& container : Containers()) {
    std::string names;
    std::set<std::string> outcomes;
    for (const Codec& codec : container.codecs) {
      names += (names.empty() ? "" : ", ") + std::string(codec.name);
      if (encoders.find(std::string(" ") + codec.encoder + " ") == std::string::npos) {
        std::cout << "skipped: this ffmpeg has no " << codec.encoder << '\n';
        continue;
      }
      SCOPED_TRACE(container.extension + std::string(" ") + codec.name);
      const std::filesystem::path file = folder / (std::string("tone") + container.extension);
      const Outcome made = Shell(
          "ffmpeg -nostdin -v error -y -f lavfi -i sine=330:duration=2:sample_rate=44100 -ac 2 "
          "-c:a " +
          std::string(codec.encoder) + " " + file.string());
      ASSERT_EQ(made.code, 0) << made.said;
      outcomes.insert(OutcomeOf(file));
    }
    if (outcomes.empty()) continue;
    ASSERT_EQ(outcomes.size(), 1U) << container.extension << ": one outcome a row";
    const std::string row = "| `" + std::string(container.extension) + "` | " + names + " | " +
                            *outcomes.begin() + " |";
    EXPECT_NE(page.find(row), std::string::npos) << "docs/song.md should say\n" << row;
  }
}

}  // namespace choreo::cli::sound_table_test
