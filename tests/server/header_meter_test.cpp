#include "server/header_meter.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>

#include "tests/server/http2.h"

namespace choreo::header_meter_test {

constexpr size_t kFrame = 16 << 10;
const std::string kPreface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

std::string Frames(int type, size_t bytes, size_t size = kFrame) {
  std::string frames;
  while (frames.size() < bytes) frames += Http2::Frame(type, 0, 1, std::string(size, 'a'));
  return frames;
}

bool Passes(const std::string& bytes, size_t at_once = 1000) {
  HeaderMeter meter;
  for (size_t at = 0; at < bytes.size(); at += at_once) {
    const auto piece = bytes.substr(at, at_once);
    if (!meter.Take({reinterpret_cast<const uint8_t*>(piece.data()), piece.size()})) return false;
  }
  return true;
}

TEST(HeaderMeterTest, MessagesMayBeLong) {
  const std::string call = Http2::Call(1, "StreamDance") + Frames(Http2::kData, 32 << 20);
  EXPECT_TRUE(Passes(kPreface + call + call));
}

TEST(HeaderMeterTest, EachCallMayHaveHeaders) {
  std::string calls = kPreface;
  for (int i = 0; i < 100; ++i) calls += Frames(Http2::kHeaders, kFrame);
  EXPECT_TRUE(Passes(calls));
}

TEST(HeaderMeterTest, HeadersHaveAnEnd) {
  const std::string begun = kPreface + Http2::Frame(Http2::kHeaders, 0, 1, "x");
  for (const size_t size : {size_t{0}, size_t{1}, kFrame}) {
    const std::string endless = begun + Frames(Http2::kContinuation, HeaderMeter::kMostBytes, size);
    for (const size_t at_once : {size_t{1}, size_t{7}, endless.size()}) {
      EXPECT_FALSE(Passes(endless, at_once)) << size << " bytes a frame";
    }
  }
}

}  // namespace choreo::header_meter_test
