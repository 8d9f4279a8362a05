#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

namespace choreo {

inline constexpr int64_t kMaxAudioFileBytes = 128 << 20;

/// Memory that the calls of a server share for music files that have not come whole. Thread-safe.
class MusicBudget {
 public:
  explicit MusicBudget(int64_t bytes) : bytes_(bytes) {}

  /// Throws Refused where so much is not left.
  void Take(int64_t bytes);
  void GiveBack(int64_t bytes);

 private:
  const int64_t bytes_;
  mutable std::mutex mutex_;  // guards the one below
  int64_t taken_ = 0;
};

/// As much of a music file as has come, in memory taken from a budget. Not thread-safe.
class MusicFile {
 public:
  explicit MusicFile(MusicBudget& budget) : budget_(budget) {}
  ~MusicFile() { Clear(); }
  MusicFile(const MusicFile&) = delete;
  MusicFile& operator=(const MusicFile&) = delete;

  /// Throws Error(kInvalidArgument, `field`) beyond kMaxAudioFileBytes, and as the budget does; the
  /// file is then as before.
  void Append(std::string_view bytes, const std::string& field);
  /// Gives the memory back.
  void Clear();

  bool empty() const { return bytes_.empty(); }
  int64_t size() const { return static_cast<int64_t>(bytes_.size()); }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(bytes_)); }

 private:
  MusicBudget& budget_;
  std::string bytes_;
  int64_t reserved_ = 0;  // of the budget; at least what bytes_ has
};

}  // namespace choreo
