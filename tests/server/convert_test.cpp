#include <gtest/gtest.h>

#include "model/core/error.h"
#include "server/read_request.h"

namespace choreo::convert_test {

TEST(ConvertTest, PcmInBothEncodings) {
  v1::AudioFormat format;
  format.set_channels(1);
  format.set_encoding(v1::AUDIO_ENCODING_PCM_S16LE);
  EXPECT_EQ(ToSamples(std::string("\x00\x40\x00\x80\xff\xff", 6), format, "audio"),
            (std::vector<float>{0.5F, -1.0F, -1.0F / 32768}));
  format.set_encoding(v1::AUDIO_ENCODING_PCM_F32LE);
  EXPECT_EQ(ToSamples(std::string("\x00\x00\x80\x3f\x00\x00\x00\xbf", 8), format, "audio"),
            (std::vector<float>{1.0F, -0.5F}));
  format.set_channels(2);
  EXPECT_THROW(ToSamples(std::string(12, '\0'), format, "audio"), Error);
}

}  // namespace choreo::convert_test
