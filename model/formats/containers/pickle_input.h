#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "model/core/error.h"

namespace choreo {

/// Reads a pickle byte by byte: opcodes and their arguments. Not thread-safe. Private to this
/// folder.
class PickleInput {
 public:
  /// `name` is the field of errors. Keeps a reference to `bytes`.
  PickleInput(std::string name, std::string_view bytes) : name_(std::move(name)), bytes_(bytes) {}

 protected:
  /// Reads the next opcode, which Refuse names from now on.
  void NextOpcode() {
    start_ = at_;
    opcode_ = Byte();
  }

  /// Throws Error(kInvalidArgument). The functions below do so for unexpected bytes.
  [[noreturn]] void Refuse(const std::string& why) const {
    char where[48];
    std::snprintf(where, sizeof where, "opcode 0x%02x at byte %zu: ", opcode_, start_);
    throw InvalidArgument(name_, where + why +
                                     "; only dicts of arrays and numbers are read, numpy.savez "
                                     "writes any arrays");
  }

  /// The next `count` bytes.
  std::string_view Take(uint64_t count) {
    if (count > bytes_.size() - at_) Refuse("the file ends within it");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  int Byte() { return static_cast<unsigned char>(Take(1)[0]); }
  /// Reads a little-endian number of `size` bytes.
  uint64_t Unsigned(size_t size) {
    uint64_t value = 0;
    const std::string_view bytes = Take(size);
    for (size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
  }
  double BigEndianDouble() { return std::bit_cast<double>(__builtin_bswap64(Unsigned(8))); }
  /// Reads up to the next line feed, which it skips.
  std::string_view Line() {
    const std::string_view line = Take(std::min(bytes_.find('\n', at_), bytes_.size()) - at_);
    Take(1);
    return line;
  }
  /// The number on a line. None if T cannot hold it.
  template <typename T>
  std::optional<T> NumberIn(std::string_view line) const {
    T number{};
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error == std::errc::result_out_of_range) return std::nullopt;
    if (error != std::errc() || end != line.data() + line.size()) Refuse("no number follows");
    return number;
  }
  /// Reads an index of the memo on a line of its own.
  uint64_t Index() { return NumberIn<uint64_t>(Line()).value_or(UINT64_MAX); }

  std::string name_;
  std::string_view bytes_;
  size_t at_ = 0, start_ = 0;  // positions of the next byte and of the opcode
  int opcode_ = 0;
};

}  // namespace choreo
