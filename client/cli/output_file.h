#pragma once

#include <filesystem>
#include <string>

namespace choreo::cli {

/// Refuses a file that could not be written, before the work whose result it is to hold: its folder
/// is not there, it is a folder itself, or may not be opened. What it holds stays. Throws
/// Error(kNotFound) or Error(kInvalidArgument) whose field is `option`, naming the path and why.
void RequireWritable(const std::string& option, const std::filesystem::path& path);

/// Refuses a file of another extension (".png"; capitals do not matter), naming the path and it.
void RequireExtension(const std::string& option, const std::filesystem::path& path,
                      const std::string& extension);

}  // namespace choreo::cli
