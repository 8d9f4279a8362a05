#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "server/settings/config.h"
#include "server/settings/config_file.h"
#include "server/settings/fault_list.h"

namespace choreo {

/// Finds numbers outside their ranges.
void CheckNumbers(const ServerConfig& config, FaultList* faults);

/// Rewrites a CLI11 error about a command line or a file in the form of our own errors: the
/// setting, its value, and what is allowed.
std::string InOurWords(const CLI::App& app, const TomlFile& file, const CLI::ParseError& error);

}  // namespace choreo
