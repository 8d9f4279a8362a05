#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <vector>

#include "client/authoring/beat_options.h"
#include "client/authoring/written_controls.h"
#include "client/cli/output_file.h"

/// The options of what client/authoring reads.
namespace choreo::cli {

/// An existing file, a pipe, or `-` for standard input.
CLI::Validator SongFile();

/// --beats, --tempo, --half-time, --double-time, --downbeat.
void AddBeatOptions(CLI::App& command, authoring::BeatOptions* options);

/// The options of these controls; --velocity-reference, too.
void AddControlOptions(CLI::App& command, authoring::WrittenControls* controls,
                       std::span<const ControlRow> rows = kControls);
/// The files that these name.
std::vector<NamedFile> FilesOf(const authoring::WrittenControls& controls);

}  // namespace choreo::cli
