#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/plan/sampler.h"
#include "server/process/time_source.h"
#include "server/settings/config.h"

namespace choreo {

/// The gRPC server on given engines, with health checking and reflection, but without choreod's
/// process. Thread-safe.
class Server {
 public:
  /// The engines of one model, one per device. The first model is the default.
  using Samplers = std::vector<std::unique_ptr<Sampler>>;

  /// Starts to listen before it returns. Uses only the settings for serving: listen, max_waiting,
  /// max_streams, io_threads, outbox_kib, max_file_music_mib, max_network_mib, TLS, tokens,
  /// reflection, metrics, and limits on clients. Throws Error(kInvalidArgument) for engines that do
  /// not match, and Error(kUnavailable), naming the address, if it cannot listen. `time`: the clock
  /// of the limits on clients; must outlive the server.
  Server(const ServerConfig& config, std::vector<Samplers> models,
         const TimeSource& time = TimeSource::System());
  ~Server();  ///< Drain(0)
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The port on which the server listens.
  int port() const;
  /// The port of the Prometheus endpoint; 0 without one.
  int metrics_port() const;
  /// The number of transitions running or waiting, over all models.
  int transitions() const;
  /// The number of calls in progress that have sent a first message.
  int calls() const;

  /// Logs and counts each call in progress as lost, for a process that ends without Drain. These
  /// calls' ends are not logged again.
  void GiveUp();

  /// Serves the models with these names from now on; the first is the default. Each is one of
  /// `fresh`, which may replace a served model of its name, or is served already. Calls in progress
  /// keep their models; a model is freed once no call uses it. Returns false, and does nothing,
  /// after Drain. Throws Error(kInvalidArgument), and changes nothing, without names, for a
  /// duplicate name, for a name without a model, and for engines that do not match.
  bool SetModels(const std::vector<std::string>& names, std::vector<Samplers> fresh);

  /// Uses these limits on calls, callers, idle times and load from now on; calls in progress stay.
  /// The limit on one connection's calls stays as it was at the start.
  void SetLimits(const ServerConfig& config);

  /// Records for /metrics whether the latest reread of the folder of models, or of the settings,
  /// succeeded.
  void NoteModelReload(bool good);
  void NoteSettingsReload(bool good);

  /// Drains the server, and has shut it down on return. At once, health becomes NOT_SERVING and new
  /// calls fail with UNAVAILABLE. Calls in progress may continue for `seconds`, and then end with
  /// UNAVAILABLE. In the last quarter of that time, streams end at their next transition. New calls
  /// get UNAVAILABLE for up to a second after the last call, but not with 0 seconds. Idempotent.
  void Drain(double seconds);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo
