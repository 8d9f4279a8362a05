#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace choreo {

/// Returns all bytes of a file. Throws Error(kNotFound), whose field is the path, if it cannot be
/// opened.
std::string ReadFile(const std::filesystem::path& path);

/// Replaces a file completely or not at all. The new content goes to a temporary file in the same
/// folder, which Commit renames; until then the old file stays. Symbolic links stay links. Devices
/// (/dev/stdout) are written directly. Not thread-safe.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();  ///< deletes the temporary file, unless Commit was called
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The temporary file, to which the caller writes.
  const std::filesystem::path& partial() const { return partial_; }
  /// Puts the new file in place. Call it after closing the temporary file. Throws Error(kInternal),
  /// whose field is the path.
  void Commit();

 private:
  std::filesystem::path path_, place_, partial_;
};

/// Writes a whole file atomically. Throws Error(kInternal), whose field is the path and whose
/// message is the cause.
void WriteFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace choreo
