#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "server/model_folder.h"
#include "server/server.h"
#include "server/settings/config.h"

namespace choreo {

/// Reads the settings again; throws Error for a bad one.
using SettingsReader = std::function<ServerConfig()>;

/// Rereads the settings and the folder of models on request. Uses its own thread, because signals
/// must be handled during the seconds that loading takes. Requests during a reread cause one more.
class Reloader {
 public:
  /// `folder`: null without one. `config`: what the server was started with. `status`: what the
  /// service manager shows while the settings are good; if they are bad, it shows their fault.
  Reloader(ServerConfig config, SettingsReader read, ModelFolder* folder, Server& server,
           std::string status);

  void Request();
  /// Stops after the file that is being read; drops further requests.
  void Stop() { thread_.request_stop(); }
  bool loads() const;
  /// --drain-seconds, as last read.
  double drain_seconds() const;

 private:
  void Run(const std::stop_token& stop);
  /// Returns the fault, or nothing.
  std::string RereadSettings();

  const SettingsReader read_;
  ModelFolder* const folder_;
  Server& server_;
  const std::string status_;
  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  ServerConfig config_;                 // lock: mutex_
  bool asked_ = false, loads_ = false;  // lock: mutex_
  std::jthread thread_;                 // last, because it uses the members above
};

}  // namespace choreo
