#pragma once

#include <filesystem>
#include <string>

namespace choreo {

/// A file in memory that only this process sees, for libraries that take a path. Whoever opens it
/// reads one whole version. Not thread-safe, but others may read it meanwhile.
class MemoryFile {
 public:
  /// Throws Error(kInternal) if the system gives none.
  explicit MemoryFile(const std::string& content);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::filesystem::path path() const;
  /// Throws what the constructor throws, and then changes nothing.
  void Replace(const std::string& content);

 private:
  int descriptor_;
};

}  // namespace choreo
