#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace choreo {

/// All bytes of a file. Throws Error(kNotFound) whose field is the path.
std::string ReadFile(const std::filesystem::path& path);

/// A file that appears when all of it is written, or not at all: what stood in its place stays
/// until then. It is written beside its place and renamed. A link stays one; what is no plain file
/// (/dev/stdout) is written where it is. Not thread-safe.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();  ///< without Commit, what was written is thrown away
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write.
  const std::filesystem::path& partial() const { return partial_; }
  /// When all is written and closed. Throws Error(kInternal) whose field is the path.
  void Commit();

 private:
  std::filesystem::path path_, place_, partial_;
};

/// Writes a whole file so. Throws Error(kInternal) whose field is the path, saying why.
void WriteFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace choreo
