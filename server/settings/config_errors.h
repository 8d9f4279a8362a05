#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "server/settings/config.h"
#include "server/settings/fault_list.h"

namespace choreo {

/// Finds numbers outside their ranges.
void CheckNumbers(const ServerConfig& config, FaultList* faults);

/// Adds what is wrong with a command line and the values in a file, after `app` has found an error
/// in them, in the form of our own errors: the setting, its value, and what is allowed. Settings
/// without a fault are set nevertheless.
void AddFaults(CLI::App& app, const CLI::ParseError& error, FaultList* faults);

/// The fault of a setting `name` that does not exist.
std::string UnknownSetting(const CLI::App& app, const std::string& name);

}  // namespace choreo
