#pragma once

#include <exception>

#include "server/model_folder.h"
#include "server/reloader.h"
#include "server/settings/config.h"

/// The life of a choreod process, from its settings to its end. Only main uses it.
namespace choreo {

/// Opens /dev/null in place of closed standard streams. Call first: a socket would otherwise get
/// their numbers, and the log would go to a client.
void OpenStandardStreams();

/// Blocks SIGTERM, SIGINT and SIGHUP until Serve handles them. Call before other threads start,
/// because they inherit the signal mask.
void HoldSignals();

/// Loads the models, reports the address, and serves. At SIGHUP it rereads the settings, by
/// `reread`, and a folder of models. Returns after SIGTERM or SIGINT and draining. Exits at once,
/// with code 0, on a stop signal before it serves, on a second one, and on one during a model's
/// loading once all calls have ended. With `check` it prints "ok" instead of serving. Throws what
/// ModelFolder, `load` and Server throw.
void Serve(const ServerConfig& config, const ModelFolder::Loader& load,
           const SettingsReader& reread);

/// The exit status of choreod after `error`. kMisused for a bad setting or a bad file that a
/// setting names, which a restart does not fix; otherwise kFailed.
int ExitCodeOf(const std::exception& error);

}  // namespace choreo
