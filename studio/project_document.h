#pragma once

#include <string>

#include "studio/studio_context.h"

/// Projects as files, for the page: it has no parser of its own. Floats stay as they are both ways.
namespace choreo::studio {

/// Reads a project or a key file, as `choreo dance` does. Throws Error(kInvalidArgument) whose
/// field is NAME:MEMBER, naming value and limit, and Error(kNotFound) for a dancer's missing keys.
Response ReadProject(const StudioContext& context, const ProjectFile& request);

/// Writes a project; refuses what ReadProject would refuse, with `kUnnamed` as the file's name.
Response WriteProject(const StudioContext& context, const Project& project);

/// The file's text, unchecked.
std::string ProjectText(const StudioContext& context, const Project& project);

/// A file of the project's dancers without their own keys (client/authoring/dancers.h).
std::string DancersText(const Project& project);

inline constexpr const char* kUnnamed = "project";  ///< the name of input in errors

}  // namespace choreo::studio
