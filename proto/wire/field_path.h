#pragma once

#include <string>
#include <string_view>

#include "model/core/error.h"

namespace choreo::wire {

// The model does not know the API: its errors name values as C++ callers do. Clients need the path
// in their message, so the server translates wherever it calls the model.

/// The path, in the API's messages, of what an error of the model names:
/// - a member of DanceConfig, GroupRequest or Key: "output_fps" -> "config.frame_rate"
/// - a parameter of a function of DanceStream: "samples" -> "audio.data"
/// - without a parameter, the function itself: "keys_complete" -> "keyframes_complete"
/// What follows is kept: "history[1].rotations" -> "config.history.poses[1].rotations". Returns
/// unknown names unchanged. Not for paths: "audio" is a name, and a path of another value.
std::string PathOf(std::string_view field);

/// What the model says, followed by the field that is the remedy, if it is one: "it has no end"
/// -> "it has no end (config.frames)".
std::string WithRemedy(std::string text, Remedy remedy);

/// The same error, about the path of its field, with its remedy.
Error AsSent(const Error& error);

/// Calls the model. Errors name paths instead. Must not contain code that throws paths.
auto WithPaths(const auto& action) {
  try {
    return action();
  } catch (const Error& error) {
    throw AsSent(error);
  }
}

}  // namespace choreo::wire
