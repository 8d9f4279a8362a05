#pragma once

#include <string>
#include <vector>

#include "server/settings/config.h"

namespace choreo {

/// What reread settings change, as in "max-streams is 128, was 64".
struct SettingsChange {
  std::vector<std::string> used;     ///< from now on
  std::vector<std::string> waiting;  ///< from the next start on
};

/// Copies the settings that a running server can change from `fresh` into `config`. Settings that
/// wait for a restart stay as they are, so that the next call reports them again.
SettingsChange TakeOver(const ServerConfig& fresh, ServerConfig* config);

}  // namespace choreo
