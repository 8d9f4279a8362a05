#pragma once

#include "client/cli/edit_options.h"

namespace choreo::cli {

/// Cuts a dance (--from, --until), mirrors it (--mirror) and joins another one (--join), in this
/// order, and writes it. Uses, or starts, a server only if something is danced: the way to the
/// other dance. Errors name the option.
void EditWhole(const EditOptions& options);

}  // namespace choreo::cli
