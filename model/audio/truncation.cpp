#include "model/audio/truncation.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "model/core/error.h"

namespace choreo {
namespace {

constexpr uint32_t kUnknownSize = 0xFFFFFFFF;  // written by programs that cannot seek back

std::string_view Text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Walks the chunks of a RIFF file to the samples.
void CheckWav(const ByteSource& source, const std::string& name) {
  std::array<std::byte, 8> head{};
  int64_t at = 12;
  while (source.read_at(at, head) == head.size()) {
    uint32_t size = 0;  // little-endian, as we are
    std::memcpy(&size, &head[4], sizeof(size));
    const int64_t body = at + 8;
    if (Text(head).substr(0, 4) == "data") {
      const int64_t held = source.size - body;
      if (size != kUnknownSize && size > held) {
        throw InvalidArgument(name, "truncated: " + std::to_string(held) + " of " +
                                        std::to_string(size) + " bytes of samples");
      }
      return;
    }
    at = body + size + size % 2;
  }
  throw InvalidArgument(
      name, "truncated: it ends at byte " + std::to_string(source.size) + ", before any samples");
}

/// Looks at the last page: "OggS", version, flags (bit 2: last page), position 8, serial 4, number
/// 4, checksum 4, number of segments, their lengths, the segments.
void CheckOgg(const ByteSource& source, const std::string& name) {
  constexpr size_t kHeader = 27;
  constexpr int64_t kLargestPage = kHeader + 255 + 255 * 255;
  std::vector<std::byte> tail(static_cast<size_t>(std::min(source.size, kLargestPage)));
  tail.resize(source.read_at(source.size - static_cast<int64_t>(tail.size()), tail));
  const size_t page = Text(tail).rfind("OggS");
  if (page != std::string_view::npos && tail.size() - page >= kHeader) {
    const auto bytes = std::span(tail).subspan(page);
    const size_t segments = std::to_integer<size_t>(bytes[kHeader - 1]);
    size_t length = kHeader + segments;
    for (size_t i = 0; i < segments && kHeader + i < bytes.size(); ++i) {
      length += std::to_integer<size_t>(bytes[kHeader + i]);
    }
    const bool is_last = (std::to_integer<int>(bytes[5]) & 4) != 0;
    if (is_last && length <= bytes.size()) return;
  }
  throw InvalidArgument(name, "truncated: its " + std::to_string(source.size) +
                                  " bytes do not end with the last page of an Ogg stream");
}

}  // namespace

void CheckNotTruncated(const ByteSource& source, const std::string& name) {
  std::array<std::byte, 12> head{};
  const size_t read = source.read_at(0, head);
  const std::string_view text = Text(std::span(head).first(read));
  if (text.starts_with("RIFF") && text.ends_with("WAVE")) CheckWav(source, name);
  if (text.starts_with("OggS")) CheckOgg(source, name);
}

}  // namespace choreo
