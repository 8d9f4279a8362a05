#pragma once

#include "client/cli/edit_options.h"

namespace choreo::cli {

/// Cuts a dance out (--from, --until), mirrors it (--mirror), puts another one behind it (--join),
/// in this order, and writes it. A server is asked, or started, only where something is danced: on
/// the way to the other dance. Errors name the option.
void EditWhole(const EditOptions& options);

}  // namespace choreo::cli
