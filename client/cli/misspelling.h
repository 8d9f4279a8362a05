#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace choreo::cli {

/// Of an unknown option in what `program` has parsed: "--sead is no option of dance; did you mean
/// --seed?". Empty where none is near, or where something else was wrong.
std::string DescribeMisspelling(const CLI::App& program);

}  // namespace choreo::cli
