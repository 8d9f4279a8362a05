#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "server/config.h"
#include "server/config_file.h"

namespace choreo {

/// Throws Error(kInvalidArgument) for the first number outside of its range.
void CheckNumbers(const ServerConfig& config);

/// What CLI11 says against a command line or a file, as our own errors say it: the setting, its
/// value, and what is allowed.
std::string InOurWords(const CLI::App& app, const TomlFile& file, const CLI::ParseError& error);

}  // namespace choreo
