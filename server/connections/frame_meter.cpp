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
  bytes = ReadPreface(bytes);
  if (is_foreign_) return Flood::kNone;
  while (!bytes.empty()) {
    const size_t skipped = std::min(skipped_, bytes.size());
    skipped_ -= skipped;
    bytes = bytes.subspan(skipped);
    // A frame may announce 16 MiB and send nothing.
    flooded_ = in_headers_ && AddHeaders(skipped) != Flood::kNone;
    if (flooded_) return Flood::kHeaders;
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

std::span<const uint8_t> FrameMeter::ReadPreface(std::span<const uint8_t> bytes) {
  const std::string_view due = kPreface.substr(preface_, bytes.size());
  is_foreign_ |= !std::equal(due.begin(), due.end(), bytes.begin());
  preface_ += due.size();
  return bytes.subspan(due.size());
}

FrameMeter::Flood FrameMeter::ReadFrame(int type, size_t length) {
  in_headers_ = type == kHeaders || type == kContinuation;
  if (type == kData) return Lack(kFullFrame - std::min(length, kFullFrame));
  if (!in_headers_) return Lack(kFullFrame);
  if (type == kHeaders) headers_ = 0;
  if (AddHeaders(kFrameHead) != Flood::kNone) return Flood::kHeaders;
  return type == kHeaders ? Lack(kFramesOfCall * kFullFrame) : Flood::kNone;
}

FrameMeter::Flood FrameMeter::AddHeaders(size_t bytes) {
  headers_ += bytes;
  return headers_ > kMostHeaderBytes ? Flood::kHeaders : Flood::kNone;
}

FrameMeter::Flood FrameMeter::Lack(size_t bytes) {
  lacking_ += bytes;
  return lacking_ > kMostEmptyFrames * kFullFrame ? Flood::kEmptyFrames : Flood::kNone;
}

}  // namespace choreo
