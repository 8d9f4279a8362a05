#pragma once

#include "client/authoring/project/project_file.h"
#include "studio/studio_context.h"

/// Projects as the page's messages. The page has no parser: client/authoring/project/project_file.h
/// reads and writes the files. Floats stay equal in both directions.
namespace choreo::studio {

inline constexpr const char* kUnnamed = "project";  ///< the name of input in errors

/// Reads a project or a key file, as `choreo dance` does. Throws Error(kInvalidArgument) whose
/// field is NAME:MEMBER, naming value and limit, and Error(kNotFound) for a dancer's missing keys.
Response ReadProject(const StudioContext& context, const ProjectFile& request);

/// Writes a project. Refuses projects that ReadProject would refuse, with `kUnnamed` as the file's
/// name.
Response WriteProject(const StudioContext& context, const Project& project);

/// The page's project without its dancers, as if read from its file. Throws Error(kInvalidArgument)
/// whose field is `kUnnamed`:MEMBER.
authoring::Project FromPage(const Project& message, const client::ModelDescription& model);

/// The dancers of the page's project, without their own keys. Throws as CheckDancers does.
authoring::Dancers StageOf(const Project& message);

}  // namespace choreo::studio
