#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace choreo::cli {

/// A file from an option; without a path, the option was not given.
struct NamedFile {
  std::string option;
  std::filesystem::path path;
};

/// Refuses, before the work, outputs that cannot be written (no such folder, a folder itself, no
/// permission) or that would destroy each other or an input. Does not change them. Throws
/// Error(kNotFound) or Error(kInvalidArgument) whose field is the option, naming the path and the
/// reason, or the other option.
void RequireOutputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

/// Refuses a file with another extension (".png"; in any case), naming both.
void RequireExtension(const std::string& option, const std::filesystem::path& path,
                      const std::string& extension);

/// Where a partial result goes: dance.npz, dance.partial.npz.
std::filesystem::path PartialPath(const std::filesystem::path& out);

}  // namespace choreo::cli
