#pragma once

#include <map>
#include <string>

#include "server/settings/config.h"

namespace CLI {
class App;
}

namespace choreo {

/// The settings that a running server changes at SIGHUP: by flag without its dashes, a function
/// that copies the setting.
using RereadSettings = std::map<std::string, void (*)(const ServerConfig& from, ServerConfig* to)>;

/// Adds all flags of choreod to `app`. Each flag fills its setting in `config`, and has an
/// environment variable: CHOREO_ and its name.
RereadSettings AddFlags(CLI::App& app, ServerConfig& config);

RereadSettings SettingsToReread();

}  // namespace choreo
