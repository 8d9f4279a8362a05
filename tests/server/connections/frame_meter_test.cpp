#include "server/connections/frame_meter.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tests/server/connections/http2.h"

namespace choreo::frame_meter_test {

using Flood = FrameMeter::Flood;

constexpr size_t kFrame = 16 << 10;
const std::string kPreface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

std::string Frames(int type, size_t bytes, size_t size = kFrame) {
  std::string frames;
  while (frames.size() < bytes) frames += Http2::Frame(type, 0, 1, std::string(size, 'a'));
  return frames;
}

Flood Read(FrameMeter* meter, const std::string& bytes, FrameMeter::Clock::time_point now = {}) {
  return meter->Read({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, now);
}

bool Passes(const std::string& bytes, size_t at_once = 1000) {
  FrameMeter meter;
  for (size_t at = 0; at < bytes.size(); at += at_once) {
    const auto piece = bytes.substr(at, at_once);
    if (Read(&meter, piece) != Flood::kNone) return false;
  }
  return true;
}

TEST(FrameMeterTest, MessagesMayBeLong) {
  const std::string call = Http2::Call(1, "StreamDance") + Frames(Http2::kData, 32 << 20);
  EXPECT_TRUE(Passes(kPreface + call + call));
}

TEST(FrameMeterTest, EachCallMayHaveHeaders) {
  std::string calls = kPreface;
  for (int i = 0; i < 100; ++i) calls += Frames(Http2::kHeaders, kFrame);
  EXPECT_TRUE(Passes(calls));
}

TEST(FrameMeterTest, HeadersHaveAnEnd) {
  const std::string begun = kPreface + Http2::Frame(Http2::kHeaders, 0, 1, "x");
  for (const size_t size : {size_t{0}, size_t{1}, kFrame}) {
    const std::string endless =
        begun + Frames(Http2::kContinuation, FrameMeter::kMostHeaderBytes, size);
    for (const size_t at_once : {size_t{1}, size_t{7}, endless.size()}) {
      EXPECT_FALSE(Passes(endless, at_once)) << size << " bytes a frame";
    }
  }
}

// A frame's head may announce 16 MiB of headers: only what comes counts.
TEST(FrameMeterTest, AnnouncedHeadersAreNotSentOnes) {
  for (const int type : {Http2::kHeaders, Http2::kContinuation}) {
    const std::string most =
        Http2::Frame(type, 0, 1, std::string(FrameMeter::kMostHeaderBytes + 1, 'a'));
    for (const size_t at_once : {size_t{1}, size_t{7}, most.size()}) {
      const std::string begun = kPreface + most.substr(0, FrameMeter::kMostHeaderBytes);
      EXPECT_TRUE(Passes(begun, at_once)) << "type " << type;
      EXPECT_FALSE(Passes(kPreface + most, at_once)) << "type " << type;
    }
  }
}

// Scanners, and TLS where there is none: gRPC closes such a connection.
TEST(FrameMeterTest, OtherProtocolsHaveNoFrames) {
  const std::string endless = Frames(Http2::kContinuation, 2 * FrameMeter::kMostHeaderBytes) +
                              std::string(200'000, '\0');  // empty DATA
  for (const std::string& begun : {std::string(24, 'J'), std::string("\x16\x03\x01\0\xee", 5),
                                   std::string("GET /metrics HTTP/1.1\r\n\r\n"),
                                   kPreface.substr(0, 23) + '\r', std::string()}) {
    for (const size_t at_once : {size_t{1}, size_t{7}, endless.size()})
      EXPECT_TRUE(Passes(begun + endless, at_once)) << begun;
  }
}

// PRIORITY, RST_STREAM, SETTINGS, PING, WINDOW_UPDATE, an unknown type, and empty DATA.
TEST(FrameMeterTest, FramesWithoutContentAreCountedBySeconds) {
  const std::vector<std::pair<int, size_t>> kinds = {{2, 5}, {3, 4},   {4, 6}, {6, 8},
                                                     {8, 4}, {250, 0}, {0, 0}};
  for (const auto& [type, length] : kinds) {
    const std::string frame = Http2::Frame(type, 0, 0, std::string(length, 'a'));
    std::string most;
    for (int i = 0; i < FrameMeter::kMostEmptyFrames; ++i) most += frame;
    FrameMeter meter;
    FrameMeter::Clock::time_point now{};
    EXPECT_EQ(Read(&meter, kPreface, now), Flood::kNone);
    for (int second = 0; second < 3; ++second, now += std::chrono::seconds(1))
      EXPECT_EQ(Read(&meter, most, now), Flood::kNone) << "type " << type;
    EXPECT_EQ(Read(&meter, most + frame, now), Flood::kEmptyFrames) << "type " << type;
  }
}

// Half-full frames may be twice as many as empty ones, and full ones are not limited.
TEST(FrameMeterTest, DataIsCountedByWhatItLacks) {
  const auto flood_after = [](size_t length) {
    const std::string frame = Http2::Frame(Http2::kData, 0, 1, std::string(length, 'a'));
    FrameMeter meter;
    Read(&meter, kPreface);
    int frames = 0;
    while (frames < 4 * FrameMeter::kMostEmptyFrames && Read(&meter, frame) == Flood::kNone)
      ++frames;
    return frames;
  };
  EXPECT_EQ(flood_after(FrameMeter::kFullFrame / 2), 2 * FrameMeter::kMostEmptyFrames);
  EXPECT_EQ(flood_after(FrameMeter::kFullFrame), 4 * FrameMeter::kMostEmptyFrames);
}

TEST(FrameMeterTest, CallsAreCountedBySeconds) {
  constexpr int kMost = FrameMeter::kMostEmptyFrames / FrameMeter::kFramesOfCall;
  std::string most;
  for (int i = 0; i < kMost; ++i) {
    most += Http2::Call(1, "StreamDance") +
            Http2::Frame(Http2::kData, 0, 1, std::string(FrameMeter::kFullFrame, 'a'));
  }
  FrameMeter meter;
  FrameMeter::Clock::time_point now{};
  EXPECT_EQ(Read(&meter, kPreface, now), Flood::kNone);
  for (int second = 0; second < 3; ++second, now += std::chrono::seconds(1))
    EXPECT_EQ(Read(&meter, most, now), Flood::kNone);
  EXPECT_EQ(Read(&meter, most + Http2::Call(1, "StreamDance"), now), Flood::kEmptyFrames);
}

}  // namespace choreo::frame_meter_test
