#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/audio/music/music_analysis.h"

namespace choreo {

inline constexpr int64_t kMaxAudioFileBytes = 128 << 20;

/// The memory limit on incomplete music files, shared by a server's calls. Thread-safe.
class MusicBudget {
 public:
  explicit MusicBudget(int64_t bytes) : bytes_(bytes) {}

  /// Reserves memory. Throws Refused if less is left.
  void Reserve(int64_t bytes);
  void GiveBack(int64_t bytes);
  double utilisation() const;  ///< the reserved share

 private:
  const int64_t bytes_;
  mutable std::mutex mutex_;  // guards the member below
  int64_t reserved_ = 0;
};

/// The received part of a music file, in memory reserved from a budget. Not thread-safe.
class MusicFile {
 public:
  explicit MusicFile(MusicBudget& budget) : budget_(budget) {}
  ~MusicFile() { Clear(); }
  MusicFile(const MusicFile&) = delete;
  MusicFile& operator=(const MusicFile&) = delete;

  /// Appends bytes. Throws Error(kInvalidArgument, `field`) beyond kMaxAudioFileBytes, and what
  /// MusicBudget::Reserve throws. The file is then unchanged.
  void Append(std::string_view bytes, const std::string& field);
  /// Empties the file and returns its memory to the budget.
  void Clear();

  bool empty() const { return bytes_.empty(); }
  int64_t size() const { return static_cast<int64_t>(bytes_.size()); }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(bytes_)); }

 private:
  MusicBudget& budget_;
  std::string bytes_;
  int64_t reserved_ = 0;  // bytes reserved from the budget; at least bytes_.size()
};

/// The decoded music of a file.
struct DecodedMusic {
  std::vector<float> mono;         ///< at kModelSampleRate
  std::vector<std::string> notes;  ///< DecodeMono's notes about damage

  /// Decodes a file. Throws what DecodeMono and `between` throw.
  static DecodedMusic Of(std::span<const std::byte> file, const std::function<void()>& between);
  double seconds() const;
  /// Analyses the music. `beats`: the client's; if empty, finds them.
  MusicAnalysis Analyse(const std::vector<double>& beats) const;
};

}  // namespace choreo
