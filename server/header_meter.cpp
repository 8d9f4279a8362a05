#include "server/header_meter.h"

#include <algorithm>
#include <utility>

namespace choreo {
namespace {

constexpr int kHeaders = 1, kContinuation = 9;

}  // namespace

bool HeaderMeter::Take(std::span<const uint8_t> bytes) {
  while (!bytes.empty()) {
    const size_t skipped = std::min(skipped_, bytes.size());
    skipped_ -= skipped;
    bytes = bytes.subspan(skipped);
    if (bytes.empty()) break;
    head_[head_bytes_++] = bytes.front();
    bytes = bytes.subspan(1);
    if (head_bytes_ < kFrameHead) continue;
    head_bytes_ = 0;
    const size_t length = size_t{head_[0]} << 16 | size_t{head_[1]} << 8 | head_[2];
    const int type = head_[3];
    if (type == kHeaders) headers_ = 0;
    if (type == kHeaders || type == kContinuation) headers_ += kFrameHead + length;
    if (headers_ > kMostBytes) return false;
    skipped_ = length;
  }
  return true;
}

}  // namespace choreo
