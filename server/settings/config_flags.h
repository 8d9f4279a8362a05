#pragma once

#include "server/settings/config.h"

namespace CLI {
class App;
}

namespace choreo {

/// Adds all flags of choreod to `app`. Each flag fills its setting in `config`, and has an
/// environment variable: CHOREO_ and its name.
void AddFlags(CLI::App& app, ServerConfig& config);

}  // namespace choreo
