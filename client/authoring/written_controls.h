#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "client/authoring/counts.h"
#include "client/authoring/dance_keys.h"
#include "client/authoring/velocities.h"
#include "client/choreo_client.h"

/// The controls of a dance as people write them down.
namespace choreo::authoring {

/// A path file, JSON, as docs/song.md describes it; times up to an hour. A smooth curve leads
/// through its points. Models run at `fps`. `counts`: those of the music, for times in
/// counts.
///
/// Throws Error(kInvalidArgument) whose field is NAME:points[i].MEMBER, naming value and limit.
ControlRequest::RootPath ParsePathFile(std::string_view text, const std::string& name, double fps,
                                       const Counts& counts = {});

/// The controls of every dance. Errors name the place in a file, or a control as the API does.
struct WrittenControls {
  std::string path;
  nlohmann::json project_path;          ///< what a path file has, inside a project; `path` wins
  std::string project_path_name;        ///< its name in errors
  PartFactors factors = {};             ///< a project's; `velocities` win
  std::vector<std::string> velocities;  ///< as ReadVelocities (velocities.h) takes them
  std::string velocity_name = "velocity_factors";  ///< how errors call them
  std::string reference;

  /// Adds a project's settings that these options do not give.
  void Follow(const WrittenControls& project);
  /// Throws Error as ParsePathFile and ReadVelocities do, Error(kNotFound) for a path file that
  /// is not there, and Error(kInvalidArgument) for a control that the model does not have, naming
  /// those of the server that do.
  ControlRequest Read(const client::ModelDescription& model,
                      const client::ServerDescription& server, const Counts& counts = {}) const;
  /// Throws Error(kInvalidArgument) naming the first point of a path or of a velocity file that
  /// begins after the end of a dance, which it is not meant for; of those given here alone.
  void RequireBegun(const ControlRequest& controls, const DanceLength& length) const;
  /// How errors call the path.
  const std::string& PathName() const { return path.empty() ? project_path_name : path; }
  /// Translates an error about sent controls to the written ones; returns others unchanged.
  Error InTermsOf(const Error& error) const;

 private:
  /// A control's name in errors: its file, or else the API's name.
  std::string NameOf(size_t row) const;
};

}  // namespace choreo::authoring
