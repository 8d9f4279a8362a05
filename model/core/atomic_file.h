#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace choreo {

/// All bytes of a file. Throws Error(kNotFound) whose field is the path.
std::string ReadFile(const std::filesystem::path& path);

/// Writes a file completely or not at all: until Commit, the old file stays in place. The new one
/// is written in the same folder and renamed. Symbolic links stay links; devices (/dev/stdout) are
/// written directly. Not thread-safe.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();  ///< discards what was written, unless Commit was called
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The path to write to.
  const std::filesystem::path& partial() const { return partial_; }
  /// Call when everything is written and closed. Throws Error(kInternal) whose field is the path.
  void Commit();

 private:
  std::filesystem::path path_, place_, partial_;
};

/// Writes a whole file atomically. Throws Error(kInternal) whose field is the path, saying why.
void WriteFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace choreo
