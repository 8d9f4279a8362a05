#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "client/authoring/keys/placing.h"

namespace choreo::cli {

/// Parses "0.3,1.6,0.2". Throws Error(kInvalidArgument, field) for anything but numbers.
std::vector<double> ParseNumbers(std::string_view text, const std::string& field);

/// Adds `--place` and `--facing`. `whose`: what is placed, "the poses of --key".
void AddPlacing(CLI::App& command, authoring::Placing& placing, const std::string& whose);

}  // namespace choreo::cli
