#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "client/authoring/dance_keys.h"
#include "client/authoring/project_file.h"
#include "client/authoring/written_controls.h"
#include "studio/studio_context.h"

namespace choreo::studio {

/// A project's dance as the client library takes it: the frames of `choreo dance --project`.
struct ProjectDance {
  client::DanceConfig config = {};
  authoring::DanceKeys keys = {};            ///< in order of time, with those that hold others
  authoring::WrittenControls controls = {};  ///< name the config's in errors

  /// Translates an error about what was sent to what the project says.
  Error InTermsOf(const Error& error) const;
};

/// `seconds`: of the dance. `song`: what is danced to, or null. Errors name `kUnnamed`.
ProjectDance DanceOf(const StudioContext& context, const authoring::Project& project,
                     const nlohmann::json& file, double seconds, const Song* song);
/// The page's project. Without `seconds` it lasts as long as its music.
ProjectDance DanceOf(const StudioContext& context, const Project& project, const Song* song);

/// Frames of the page's dance, danced anew.
Response MakeTakes(const StudioContext& context, const Song* song, const Retake& request);

}  // namespace choreo::studio
