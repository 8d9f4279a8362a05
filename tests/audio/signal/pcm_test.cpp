#include "model/audio/signal/pcm.h"

#include <gtest/gtest.h>

#include "model/core/error.h"

namespace choreo::pcm_test {

TEST(Pcm, IsReadInBothEncodings) {
  EXPECT_EQ(ReadPcm(std::string("\x00\x40\x00\x80\xff\xff", 6), /*floats=*/false, 1, "audio"),
            (std::vector<float>{0.5F, -1.0F, -1.0F / 32768}));
  const std::string floats("\x00\x00\x80\x3f\x00\x00\x00\xbf\x00\x00\x00\x00", 12);
  EXPECT_EQ(ReadPcm(floats, /*floats=*/true, 1, "audio"), (std::vector<float>{1.0F, -0.5F, 0}));
  EXPECT_THROW(ReadPcm(floats, /*floats=*/true, 2, "audio"), Error);
}

}  // namespace choreo::pcm_test
