#pragma once

#include "server/config.h"
#include "server/model_folder.h"

/// The life of a choreod between its settings and its end. Of a process, so for main alone.
namespace choreo {

/// From here on SIGTERM, SIGINT and SIGHUP wait for Serve. Call before other threads start: they
/// inherit it.
void HoldSignals();

/// Loads the models, says where it listens, serves, and reads a folder of models again at SIGHUP.
/// Returns after SIGTERM or SIGINT (or SIGHUP without a folder) has had it drain. Leaves the
/// process at once, with exit code 0, where it is asked to go before it serves, for the second
/// time, or while a model is being loaded and all calls are over. Throws what ModelFolder, `load`
/// and Server throw.
void Serve(const ServerConfig& config, const ModelFolder::Loader& load);

}  // namespace choreo
