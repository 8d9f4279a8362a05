#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "model/core/error.h"

namespace choreo::studio {

/// A folder for temporary files; removed with it.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "choreo-studio-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw Error(ErrorCode::kInternal, name, "this folder cannot be made");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace choreo::studio
