#include "client/cli/output_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "model/core/error.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {

void RequireWritable(const std::string& option, const std::filesystem::path& path) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder))
    throw Error(ErrorCode::kNotFound, option, path.string() + ": no folder " + folder.string());
  if (std::filesystem::is_directory(path))
    throw InvalidArgument(option, path.string() + " is a folder");
  // Trying is the only question that has a sure answer; nothing is left behind.
  const bool is_new = !std::filesystem::exists(path);
  errno = 0;
  const bool opens = std::ofstream(path, std::ios::app).is_open();
  const int reason = errno;
  if (!opens) {
    throw InvalidArgument(option, path.string() + " cannot be written: " + std::strerror(reason));
  }
  if (is_new) std::filesystem::remove(path);
}

void RequireExtension(const std::string& option, const std::filesystem::path& path,
                      const std::string& extension) {
  if (SmallExtension(path) != extension)
    throw InvalidArgument(option, path.string() + " does not end in " + extension);
}

}  // namespace choreo::cli
