#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace choreo::fuzz {

/// An input as a file, for what reads nothing else. One a process, overwritten by the next.
class InputFile {
 public:
  /// `extension`: ".npz".
  explicit InputFile(const std::string& extension)
      : path_(std::filesystem::temp_directory_path() /
              ("choreo_fuzz." + std::to_string(getpid()) + extension)) {}
  ~InputFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& Holding(std::string_view bytes) const {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);  // ext4 flushes what is written over
    std::ofstream(path_, std::ios::binary).write(bytes.data(), std::ssize(bytes));
    return path_;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace choreo::fuzz
