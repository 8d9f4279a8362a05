#include "server/process/memory_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "model/core/error.h"

namespace choreo {
namespace {

int Make(const std::string& content) {
  const int made = memfd_create("choreod", MFD_CLOEXEC);
  size_t written = 0;
  while (made >= 0 && written < content.size()) {
    const ssize_t count = write(made, content.data() + written, content.size() - written);
    if (count < 0) break;
    written += static_cast<size_t>(count);
  }
  if (made >= 0 && written == content.size()) return made;
  const std::string why = std::strerror(errno);
  if (made >= 0) close(made);
  throw Error(ErrorCode::kInternal, "", "no file in memory: " + why);
}

}  // namespace

MemoryFile::MemoryFile(const std::string& content) : descriptor_(Make(content)) {}

MemoryFile::~MemoryFile() { close(descriptor_); }

std::filesystem::path MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(descriptor_);
}

void MemoryFile::Replace(const std::string& content) {
  const int made = Make(content);
  dup3(made, descriptor_, O_CLOEXEC);  // from now on the path names the new file
  close(made);
}

}  // namespace choreo
