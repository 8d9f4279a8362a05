#pragma once

#include <string>

#include "client/authoring/controls/written_controls.h"
#include "client/authoring/keys/dance_keys.h"
#include "client/authoring/project/project_file.h"
#include "studio/studio_context.h"

namespace choreo::studio {

/// A project's dance in the client library's form. It has the frames of `choreo dance --project`.
struct ProjectDance {
  client::DanceConfig config = {};
  authoring::DanceKeys keys = {};  ///< in order of time, including the keys that hold others
  authoring::WrittenControls controls = {};  ///< for naming config.controls in errors

  /// Translates an error about the sent request to the project's fields.
  Error InTermsOf(const Error& error) const;
};

/// The counts of the project's own beats or else of the song, which may be null.
authoring::Counts CountsOf(const authoring::Project& project, const Song* song);

/// `seconds`: the dance's length. `song`: the dance's music, or null. Errors name `kUnnamed`.
ProjectDance DanceOf(const StudioContext& context, const authoring::Project& project,
                     double seconds, const Song* song);
/// The page's project. Without `seconds` it lasts as long as its music.
ProjectDance DanceOf(const StudioContext& context, const Project& project, const Song* song);

/// Dances the frames of the page's project anew.
Response MakeTakes(const StudioContext& context, const Song* song, const Retake& request);

}  // namespace choreo::studio
