#pragma once

#include "client/cli/edit/edit_options.h"

namespace choreo::cli {

/// Cuts a dance (--from, --until), mirrors it (--mirror) and joins another one to it (--join), in
/// this order, and writes it. Calls or starts a server only to generate the transition to the other
/// dance. Errors name the option.
void EditWhole(const EditOptions& options);

}  // namespace choreo::cli
