#pragma once

#include <nlohmann/json_fwd.hpp>

#include "studio/studio_context.h"

/// Reads and writes project files for the page, which has no parser. Floats are preserved in both
/// directions.
namespace choreo::studio {

/// Reads a project or a key file, as `choreo dance` does. Throws Error(kInvalidArgument) whose
/// field is NAME:MEMBER, naming value and limit, and Error(kNotFound) for a dancer's missing keys.
Response ReadProject(const StudioContext& context, const ProjectFile& request);

/// Writes a project. Refuses projects that ReadProject would refuse, with `kUnnamed` as the file's
/// name.
Response WriteProject(const StudioContext& context, const Project& project);

/// The file's content, unchecked.
nlohmann::ordered_json ProjectJson(const StudioContext& context, const Project& project);

/// The content of a file of the project's dancers without their own keys
/// (client/authoring/dancers.h).
nlohmann::ordered_json DancersJson(const Project& project);

inline constexpr const char* kUnnamed = "project";  ///< the name of input in errors

}  // namespace choreo::studio
