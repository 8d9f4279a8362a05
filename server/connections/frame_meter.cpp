#include "server/connections/frame_meter.h"

#include <algorithm>

namespace choreo {
namespace {

constexpr int kData = 0, kHeaders = 1, kContinuation = 9;

}  // namespace

FrameMeter::Flood FrameMeter::Read(std::span<const uint8_t> bytes, Clock::time_point now) {
  if (now >= second_ends_) {
    second_ends_ = now + std::chrono::seconds(1);
    lacking_ = 0;
  }
  while (!bytes.empty()) {
    const size_t skipped = std::min(skipped_, bytes.size());
    skipped_ -= skipped;
    bytes = bytes.subspan(skipped);
    if (bytes.empty()) break;
    head_[head_bytes_++] = bytes.front();
    bytes = bytes.subspan(1);
    if (head_bytes_ < kFrameHead) continue;
    head_bytes_ = 0;
    skipped_ = size_t{head_[0]} << 16 | size_t{head_[1]} << 8 | head_[2];
    const Flood flood = ReadFrame(head_[3], skipped_);
    flooded_ = flood != Flood::kNone;
    if (flooded_) return flood;
  }
  return Flood::kNone;
}

FrameMeter::Flood FrameMeter::ReadFrame(int type, size_t length) {
  if (type == kData) return Lack(kFullFrame - std::min(length, kFullFrame));
  if (type != kHeaders && type != kContinuation) return Lack(kFullFrame);
  if (type == kHeaders) headers_ = 0;
  headers_ += kFrameHead + length;
  if (headers_ > kMostHeaderBytes) return Flood::kHeaders;
  return type == kHeaders ? Lack(kFramesOfCall * kFullFrame) : Flood::kNone;
}

FrameMeter::Flood FrameMeter::Lack(size_t bytes) {
  lacking_ += bytes;
  return lacking_ > kMostEmptyFrames * kFullFrame ? Flood::kEmptyFrames : Flood::kNone;
}

}  // namespace choreo
