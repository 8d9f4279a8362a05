#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace choreo::cli {

/// A file as a command line names it; without a path, the option was not given.
struct NamedFile {
  std::string option;
  std::filesystem::path path;
};

/// Refuses, before the work whose results they are to hold, outputs that could not be written (no
/// such folder, a folder itself, may not be opened) or that would destroy each other or an input.
/// What they hold stays. Throws Error(kNotFound) or Error(kInvalidArgument) whose field is the
/// option, naming the path and why, or the other option.
void RequireOutputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

/// Refuses a file of another extension (".png"; capitals do not matter), naming the path and it.
void RequireExtension(const std::string& option, const std::filesystem::path& path,
                      const std::string& extension);

/// Where a part of it goes, beside what was to be written: dance.npz, dance.partial.npz.
std::filesystem::path PartialPath(const std::filesystem::path& out);

}  // namespace choreo::cli
