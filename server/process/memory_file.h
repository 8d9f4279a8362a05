#pragma once

#include <filesystem>
#include <string>

namespace choreo {

/// An in-memory file that only this process sees, for libraries that take a path. Each open file
/// shows one complete version. Not thread-safe, but other threads may read the file during Replace.
class MemoryFile {
 public:
  /// Throws Error(kInternal) if the system cannot create the file.
  explicit MemoryFile(const std::string& content);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::filesystem::path path() const;
  /// Replaces the content. Throws what the constructor throws, and then changes nothing.
  void Replace(const std::string& content);

 private:
  int descriptor_;
};

}  // namespace choreo
