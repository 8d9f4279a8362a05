#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <vector>

#include "client/authoring/controls/written_controls.h"
#include "client/authoring/music/beat_options.h"
#include "client/cli/options/output_file.h"

/// Command-line options for the inputs that client/authoring reads.
namespace choreo::cli {

/// An existing file, a pipe, or `-` for standard input.
CLI::Validator SongFile();

/// Adds --beats, --tempo, --half-time, --double-time and --downbeat.
void AddBeatOptions(CLI::App& command, authoring::BeatOptions* options);

/// Adds the options of these controls, and --velocity-reference.
void AddControlOptions(CLI::App& command, authoring::WrittenControls* controls,
                       std::span<const ControlRow> rows = kControls);
/// The files that the options of controls name.
std::vector<NamedFile> FilesOf(const authoring::WrittenControls& controls);

}  // namespace choreo::cli
