#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace choreo::cli {

/// Explains an unknown command or option in what `program` has parsed: "danse is no command; did
/// you mean dance?", "--sead is no option of dance; did you mean --seed?". Empty if no option is
/// near, or something else was wrong.
std::string DescribeMisspelling(const CLI::App& program);

}  // namespace choreo::cli
