#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sndfile.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "model/audio/decode/decode.h"
#include "model/core/error.h"
#include "tests/support/temporary_folder.h"

/// Sound files as libsndfile writes them, and what decoding says of them.
namespace choreo::decode_test {

using ::testing::HasSubstr;

/// libsndfile writes a variable bit rate.
inline constexpr int kMp3 = SF_FORMAT_MPEG | SF_FORMAT_MPEG_LAYER_III;

class DecodeTest : public ::testing::Test {
 protected:
  std::filesystem::path Write(int format, int rate, int channels,
                              std::span<const float> wave) const {
    const auto path = folder_ / "sound";
    SF_INFO info{};
    info.samplerate = rate;
    info.channels = channels;
    info.format = format;
    SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
    EXPECT_NE(file, nullptr) << sf_strerror(nullptr);
    const sf_count_t frames = static_cast<sf_count_t>(wave.size()) / channels;
    EXPECT_EQ(sf_writef_float(file, wave.data(), frames), frames);
    sf_close(file);
    return path;
  }

  std::filesystem::path WriteBytes(const std::string& bytes) const {
    const auto path = folder_ / "bytes";
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  static std::string Bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  DecodedAudio Decode(const std::string& bytes) const { return DecodeAudioFile(WriteBytes(bytes)); }

  static std::string Refusal(const std::string& bytes) {
    try {
      DecodeMono(std::as_bytes(std::span(bytes)));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
      EXPECT_THAT(error.field(), ::testing::StartsWith("audio"));
      return error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
};

}  // namespace choreo::decode_test
