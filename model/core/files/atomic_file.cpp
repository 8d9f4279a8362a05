#include "model/core/files/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "model/core/error.h"

namespace choreo {

std::string ReadFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    throw Error(ErrorCode::kNotFound, path.string(), "cannot be opened");
  }
  std::ostringstream text;
  if (file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  return std::move(text).str();
}

AtomicFile::AtomicFile(const std::filesystem::path& path)
    : path_(path), place_(path), partial_(path) {
  std::error_code unknown;
  if (std::filesystem::is_symlink(path, unknown)) {
    place_ = std::filesystem::weakly_canonical(path, unknown);
    if (unknown) place_ = path;
  }
  const auto there = std::filesystem::status(place_, unknown).type();
  const bool is_device = there != std::filesystem::file_type::regular &&
                         there != std::filesystem::file_type::not_found;
  partial_ = is_device ? place_ : std::filesystem::path(place_.string() + ".partial");
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (partial_ != place_) std::filesystem::remove(partial_, ignored);
}

void AtomicFile::Commit() {
  if (partial_ == place_) return;
  std::error_code error;
  std::filesystem::rename(partial_, place_, error);
  if (error) {
    throw Error(ErrorCode::kInternal, path_.string(), "cannot be written: " + error.message());
  }
}

void WriteFile(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  errno = 0;
  std::ofstream out(file.partial(), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) {
    throw Error(ErrorCode::kInternal, path.string(),
                std::string("cannot be written: ") + std::strerror(errno));
  }
  file.Commit();
}

}  // namespace choreo
