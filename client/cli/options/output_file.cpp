#include "client/cli/options/output_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>

#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/files/small_extension.h"
#include "model/core/joined.h"

namespace choreo::cli {
namespace {

namespace fs = std::filesystem;

void RequireWritable(const NamedFile& file) {
  const std::string name = file.path.string();
  const auto refuse = [&](const std::string& why) {
    throw InvalidArgument(file.option, name + " cannot be written: " + why);
  };
  const fs::path folder = file.path.has_parent_path() ? file.path.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw Error(ErrorCode::kNotFound, file.option, name + ": no folder " + folder.string());
  const fs::file_type there = fs::status(file.path, error).type();
  if (there == fs::file_type::none) refuse(error.message());
  if (there == fs::file_type::directory) throw InvalidArgument(file.option, name + " is a folder");
  // Tries to write, as only that gives a reliable answer; leaves no file behind.
  const auto open = [&](const fs::path& path) {
    errno = 0;
    if (!std::ofstream(path, std::ios::app).is_open()) refuse(std::strerror(errno));
  };
  if (there != fs::file_type::not_found) open(file.path);
  const AtomicFile beside(file.path);
  open(beside.partial());
}

/// Whether two paths are the same file. Compares missing files by their resolved names.
bool SameFile(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return fs::is_regular_file(a, error);
  const auto whole = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path, error), error);
  };
  return whole(a) == whole(b) && !fs::exists(a, error);
}

}  // namespace

void RequireOutputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  const auto refuse = [](const NamedFile& output, const NamedFile& other, const char* use) {
    throw InvalidArgument(output.option,
                          output.path.string() + " is the file that " + other.option + use);
  };
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    if (output->path.empty()) continue;
    RequireWritable(*output);
    for (auto other = outputs.begin(); other != output; ++other)
      if (SameFile(output->path, other->path)) refuse(*output, *other, " is written to");
    for (const NamedFile& input : inputs)
      if (SameFile(output->path, input.path)) refuse(*output, input, " is read from");
  }
}

void RequireExtension(const std::string& option, const std::filesystem::path& path,
                      const std::vector<std::string>& extensions) {
  if (std::ranges::find(extensions, SmallExtension(path)) != extensions.end()) return;
  throw InvalidArgument(
      option, path.string() + " does not end in " + Joined(extensions, std::identity(), " or "));
}

std::filesystem::path PartialPath(const std::filesystem::path& out) {
  std::filesystem::path path = out;
  return path.replace_filename(out.stem().string() + ".partial" + out.extension().string());
}

}  // namespace choreo::cli
