#pragma once

#include "client/cli/edit/edit_options.h"

namespace choreo::cli {

/// Whether the file given to `choreo edit` is a project, which has markers, instead of a dance.
bool IsProject(const EditOptions& options);

/// Sets, moves and removes markers of a project (--mark, --unmark) and writes it, otherwise
/// unchanged. Errors name the option.
void EditMarkers(const EditOptions& options);

}  // namespace choreo::cli
