#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "client/choreo_client.h"

/// The controls of a dance as people write them down.
namespace choreo::cli {

/// A path file, JSON:
///
///     {"points": [{"time": 0, "x": 0, "z": 0}, {"time": 2.5, "x": 1, "z": 0.5}, ...]}
///
/// At least two points, in order of time: where the root should be, metres, in the world (x to the
/// left of a dancer who faces the audience, z towards it). A smooth curve leads through them.
/// `time` counts in seconds from the start of the music; `frame` may stand in its place. `y` is the
/// height of the root above the floor, for jumps and squats: in all points or in none. Other
/// members of the file's outermost object are ignored; within a point they are errors.
///
/// Throws Error(kInvalidArgument) whose field is NAME:points[i].MEMBER, naming value and limit.
/// Models run at `fps`.
client::Controls::RootPath ParsePathFile(std::string_view text, const std::string& name,
                                         double fps);

/// The options of every command that dances.
struct ControlOptions {
  std::string path;
  std::vector<std::string> velocities;  ///< PART=FACTOR
  std::string reference;

  void AddTo(CLI::App& command);
  /// Throws Error as ParsePathFile does, Error(kNotFound) for a file that is not there, and
  /// Error(kInvalidArgument) whose field is "--velocity".
  client::Controls Read(double fps) const;
  /// An error about controls as they were sent in terms of these options; any other as it is.
  Error InTermsOf(const Error& error) const;
};

}  // namespace choreo::cli
