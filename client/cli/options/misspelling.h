#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace choreo::cli {

/// Explains an unknown command or option in the command line that `program` has parsed: "danse is
/// no command; did you mean dance?", "--sead is no option of dance; did you mean --seed?". Returns
/// an empty string if no name is similar, or for another error.
std::string DescribeMisspelling(const CLI::App& program);

}  // namespace choreo::cli
