#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "server/settings/config.h"
#include "server/settings/config_file.h"

namespace choreo {

/// Throws Error(kInvalidArgument) for the first number outside its range.
void CheckNumbers(const ServerConfig& config);

/// Rewrites a CLI11 error about a command line or a file in the form of our own errors: the
/// setting, its value, and what is allowed.
std::string InOurWords(const CLI::App& app, const TomlFile& file, const CLI::ParseError& error);

}  // namespace choreo
