// Agreement with output of librosa 0.10.2. Skipped if the files are absent: CHOREO_GOLDEN names
// their folder (default: ../shared/golden beside the repository).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/audio/beats/beats.h"
#include "model/audio/decode/decode.h"
#include "model/audio/music/feature_stream.h"
#include "model/audio/signal/mfcc.h"
#include "model/core/files/npy.h"

namespace choreo::golden_test {

std::filesystem::path GoldenFolder() {
  const char* named = std::getenv("CHOREO_GOLDEN");
  const std::filesystem::path root =
      named ? std::filesystem::path(named)
            : std::filesystem::path(CHOREO_SOURCE_DIR) / ".." / "shared" / "golden";
  return root / "audio";
}

struct Difference {
  double largest = 0;
  double relative_rms = 0;  // relative to the RMS of the expected values
};

Difference Compare(std::span<const float> values, std::span<const float> expected) {
  double squares = 0, reference = 0;
  Difference difference;
  for (size_t i = 0; i < expected.size(); ++i) {
    const double error = static_cast<double>(values[i]) - expected[i];
    difference.largest = std::max(difference.largest, std::abs(error));
    squares += error * error;
    reference += static_cast<double>(expected[i]) * expected[i];
  }
  difference.relative_rms = std::sqrt(squares / reference);
  return difference;
}

class GoldenTest : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(GoldenFolder())) {
      GTEST_SKIP() << GoldenFolder() << " is absent (CHOREO_GOLDEN names it)";
    }
    const DecodedAudio audio = DecodeAudioFile(File(".wav"));
    ASSERT_EQ(audio.sample_rate, kModelSampleRate);
    mono_ = ToModelRate(audio);
  }

  std::filesystem::path File(const std::string& suffix) const {
    return GoldenFolder() / (GetParam() + suffix);
  }

  static void Report(const std::string& what, const Difference& difference) {
    std::cout << "  " << GetParam() << " " << what << ": largest difference " << difference.largest
              << ", relative RMS " << difference.relative_rms << "\n";
  }

  void ExpectMfcc(const std::string& file, const FeatureMatrix& rows) const {
    const NpyArray golden = ReadNpy(File(file));
    ASSERT_EQ(golden.shape, (std::vector<int64_t>{rows.rows(), kMfccCount}));
    const Difference difference =
        Compare({rows.data(), static_cast<size_t>(rows.size())}, golden.As<float>());
    Report(file, difference);
    EXPECT_LT(difference.largest, 0.05);
    EXPECT_LT(difference.relative_rms, 1e-3);
  }

  std::vector<float> mono_;
};

TEST_P(GoldenTest, Mfcc) { ExpectMfcc(".mfcc40_hop735_notopdb.npy", Mfcc(mono_)); }

TEST_P(GoldenTest, FeatureStream) {
  FeatureStream stream(kModelSampleRate, 1);
  stream.Push(mono_);
  stream.Finish();
  FeatureMatrix rows(stream.audio_rows(), kMfccCount);
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    MfccOfMelDb(stream.Bands(r), std::span<float, kMfccCount>(rows.row(r).data(), kMfccCount));
  }
  ExpectMfcc(".mfcc40_hop735_notopdb.npy", rows);
}

TEST_P(GoldenTest, TempoAndBeats) {
  std::ifstream file(File(".beats.json"));
  const nlohmann::json golden = nlohmann::json::parse(file);
  const auto expected = golden.at("beat_seconds").get<std::vector<double>>();
  const BeatTrack track = FindBeats(mono_);
  // librosa's tempo is a whole number of frames a beat.
  const double tempo = golden.at("tempo_bpm").get<double>();
  EXPECT_NEAR(track.tempo_bpm, tempo, 0.03 * tempo);
  std::vector<double> beats = track.Seconds();
  // librosa omits beats at both ends.
  std::erase_if(beats, [&](double beat) {
    return beat < expected.front() - 0.07 || beat > expected.back() + 0.07;
  });
  int64_t near = 0;
  for (const double beat : beats) {
    near += std::ranges::any_of(expected,
                                [beat](double other) { return std::abs(other - beat) <= 0.07; });
  }
  const double share =
      static_cast<double>(near) / static_cast<double>(std::max(expected.size(), beats.size()));
  std::cout << "  " << GetParam() << " beats: " << near << " of " << expected.size()
            << " within 70 ms, " << beats.size() << " found\n";
  EXPECT_GE(share, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Librosa, GoldenTest,
                         ::testing::Values("clicks_22050", "feelings_30s_22050"));

}  // namespace choreo::golden_test
