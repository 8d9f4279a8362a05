#pragma once

#include <exception>

#include "server/config.h"
#include "server/model_folder.h"

/// The life of a choreod process from its settings to its end; for main only.
namespace choreo {

/// Makes SIGTERM, SIGINT and SIGHUP wait for Serve. Call before other threads start, which inherit
/// it.
void HoldSignals();

/// Loads the models, reports where it listens, serves, and rereads a folder of models at SIGHUP.
/// Returns after SIGTERM or SIGINT (or SIGHUP without a folder) and draining. Exits at once, with
/// code 0, on a stop signal before it serves, on a second one, or on one that comes while it loads
/// a model and all calls have ended. With `check` prints "ok" in place of serving. Throws what
/// ModelFolder, `load` and Server throw.
void Serve(const ServerConfig& config, const ModelFolder::Loader& load);

/// The exit status of a choreod that `error` ended: kMisused for a bad setting or a bad file that
/// one names, which a restart does not mend; else kFailed.
int ExitCodeOf(const std::exception& error);

}  // namespace choreo
