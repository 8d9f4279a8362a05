#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/engine/sampler.h"
#include "server/config.h"

namespace choreo {

/// choreod without its process: the gRPC server over engines that somebody else has built. Health
/// checking and reflection are part of it. Thread-safe.
class Server {
 public:
  /// The engines of one model, one a device. The first model is the default.
  using Samplers = std::vector<std::unique_ptr<Sampler>>;

  /// Listens when it returns. Of `config` only what concerns serving is read: listen, max_waiting,
  /// max_streams, io_threads, outbox_kib, max_file_music_mib, max_network_mib, TLS, tokens,
  /// reflection, metrics, and what clients may take. Throws Error(kInvalidArgument) for engines
  /// that do not go together, Error(kUnavailable) naming an address that cannot be listened on.
  Server(const ServerConfig& config, std::vector<Samplers> models);
  ~Server();  ///< Drain(0)
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// The port that was chosen.
  int port() const;
  /// Where Prometheus finds figures; 0 without.
  int metrics_port() const;
  /// Transitions that are being made, or wait, over all
  /// models.
  int transitions() const;
  /// Calls in progress; those without a first message do not count.
  int calls() const;

  /// Served from now on, the first one as the default: by name models of `fresh`, which are new or
  /// take the place of one of that name, and models that are served already. Calls in progress
  /// keep what they began with; a model is freed once nobody is left who dances it. False, and
  /// nothing happens, after Drain. Throws Error(kInvalidArgument), and changes nothing, for no
  /// names, a name twice, one that no model has, and engines that do not go together.
  bool SetModels(const std::vector<std::string>& names, std::vector<Samplers> fresh);

  /// Health says NOT_SERVING and new calls are UNAVAILABLE from the start on; those in progress may
  /// go on for `seconds`, then end as UNAVAILABLE; streams at a transition, if one comes in the
  /// last quarter. Those who come up to a second after the last one are still told so (0 seconds:
  /// nobody is). When it returns the server is shut down. Idempotent.
  void Drain(double seconds);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace choreo
