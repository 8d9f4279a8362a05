#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/plan/sampler.h"
#include "server/config.h"

namespace choreo {

/// choreod without its process: the gRPC server on given engines, with health checking and
/// reflection. Thread-safe.
class Server {
 public:
  /// The engines of one model, one per device. The first model is the default.
  using Samplers = std::vector<std::unique_ptr<Sampler>>;

  /// Listens when it returns. Uses only the settings about serving: listen, max_waiting,
  /// max_streams, io_threads, outbox_kib, max_file_music_mib, max_network_mib, TLS, tokens,
  /// reflection, metrics, and limits on clients. Throws Error(kInvalidArgument) for engines that do
  /// not match, Error(kUnavailable) naming an address that cannot be listened on.
  Server(const ServerConfig& config, std::vector<Samplers> models);
  ~Server();  ///< Drain(0)
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The port that it listens on.
  int port() const;
  /// The port for Prometheus; 0 without.
  int metrics_port() const;
  /// Transitions running or waiting, over all models.
  int transitions() const;
  /// Calls in progress, except those without a first message.
  int calls() const;

  /// Logs and counts each call in progress as lost, for a process that ends without Drain. Their
  /// ends are not logged again.
  void GiveUp();

  /// Serves these from now on, the first one as the default: by name, models of `fresh`, which are
  /// new or replace one of that name, and models already served. Calls in progress keep theirs; a
  /// model is freed once nobody dances it. Returns false, and does nothing, after Drain. Throws
  /// Error(kInvalidArgument), and changes nothing, for no names, a duplicate, one without a model,
  /// and engines that do not match.
  bool SetModels(const std::vector<std::string>& names, std::vector<Samplers> fresh);

  /// Tells /metrics whether the latest reread of a folder of models succeeded.
  void NoteModelReload(bool good);

  /// Health is NOT_SERVING and new calls are UNAVAILABLE at once; calls in progress may continue
  /// for `seconds`, then end as UNAVAILABLE; streams end at a transition, if one comes in the last
  /// quarter. Callers up to a second after the last call still get this status (0 seconds: none
  /// do). The server is shut down on return. Idempotent.
  void Drain(double seconds);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo
