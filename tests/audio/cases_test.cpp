// Songs written by other programs, or misjudged by beat trackers. Skipped if the files are absent:
// CHOREO_CASES names their folder (default: ../shared/cases beside the repository).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "model/audio/beats/beats.h"
#include "model/audio/decode/decode.h"
#include "model/metrics/song_beats.h"

namespace choreo::audio_cases_test {

class AudioCases : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* named = std::getenv("CHOREO_CASES");
    folder_ = named ? std::filesystem::path(named)
                    : std::filesystem::path(CHOREO_SOURCE_DIR) / ".." / "shared" / "cases";
    folder_ /= "audio";
    if (!std::filesystem::exists(folder_))
      GTEST_SKIP() << folder_ << " is absent (CHOREO_CASES names it)";
  }

  DecodedAudio Decode(const std::string& name) const { return DecodeAudioFile(folder_ / name); }

  /// F at 70 ms between a file's beats and those in a .beats file.
  double FMeasure(const std::string& song, const std::string& map, BeatTrack* track) const {
    *track = FindBeats(ToModelRate(Decode(song)));
    std::ifstream file(folder_ / map);
    std::vector<double> known;
    for (double beat = 0; file >> beat;) known.push_back(beat);
    return BeatFMeasure(track->Seconds(), known);
  }

  std::filesystem::path folder_;
};

TEST_F(AudioCases, FilesAreReadToTheirEnd) {
  EXPECT_NEAR(Decode("07_ogg_flac.oga").seconds(), 8, 0.001);
  EXPECT_NEAR(Decode("08_mp3_begins_mid_frame.mp3").seconds(), 8, 0.1);
  EXPECT_NEAR(Decode("09_mp3_in_wav.wav").seconds(), 8, 0.1);
  const DecodedAudio cut = Decode("10_ogg_without_last_page.ogg");
  EXPECT_GT(cut.seconds(), 1);
  EXPECT_THAT(cut.notes, ::testing::Contains(::testing::HasSubstr("last page")));
}

TEST_F(AudioCases, BeatsAreCountedAtTheirTempo) {
  BeatTrack track;
  EXPECT_GT(FMeasure("13_140_bpm.flac", "13_140_bpm.beats", &track), 0.95);
  EXPECT_NEAR(track.tempo_bpm, 140, 1);
  for (const std::string song : {"14_120_bpm.flac", "15_antiphase.flac", "16_dc_offset.flac"}) {
    EXPECT_GT(FMeasure(song, "14_120_bpm.beats", &track), song[1] == '5' ? 0.6 : 0.95) << song;
    EXPECT_NEAR(track.tempo_bpm, 120, 0.6) << song;
  }
  EXPECT_THAT(Decode("15_antiphase.flac").notes,
              ::testing::Contains(::testing::HasSubstr("cancel")));
}

}  // namespace choreo::audio_cases_test
