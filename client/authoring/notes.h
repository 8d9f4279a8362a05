#pragma once

#include <functional>
#include <string>

/// This library prints nothing: it passes notes about songs, beats and motions to the program.
namespace choreo::authoring {

/// Receives a line for people: "note: song.wav: ..." or "warning: --tempo ...". Called from any
/// thread.
using NoteSink = std::function<void(const std::string& line)>;

/// Sets the process's sink; without one, lines are dropped. Call it before other threads start.
void SetNoteSink(NoteSink sink);

/// For this library: passes a line to the sink.
void Note(const std::string& line);

}  // namespace choreo::authoring
