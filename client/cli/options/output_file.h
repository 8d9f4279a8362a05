#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace choreo::cli {

/// A file named by an option. An empty path means that the option was not given.
struct NamedFile {
  std::string option;
  std::filesystem::path path;
};

/// Checks outputs before the work. Refuses files that cannot be written (no such folder, a folder
/// itself, no permission) or would overwrite each other or an input. Changes no file. Throws
/// Error(kNotFound) or Error(kInvalidArgument) whose field is the option, naming the path and the
/// reason, or the other option.
void RequireOutputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

/// Refuses a file with none of these extensions (".png", in upper or lower case). The error names
/// them all.
void RequireExtension(const std::string& option, const std::filesystem::path& path,
                      const std::vector<std::string>& extensions);

/// The path for a partial result: dance.partial.npz for dance.npz.
std::filesystem::path PartialPath(const std::filesystem::path& out);

}  // namespace choreo::cli
