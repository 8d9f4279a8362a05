#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/authoring/local_server.h"
#include "client/choreo_client.h"

namespace choreo::cli {

/// The options of all commands that need a server.
struct ServerOptions {
  std::vector<std::string> addresses;
  bool tls = false;
  std::string ca_certificate, client_certificate, client_key, server_name, token_file;
  double deadline_s = 0;
  bool allow_inexact_resume = false;
  bool even_draining = false;

  void AddTo(CLI::App& command);
  /// Adds --allow-inexact-resume, for commands whose dances can resume on another server.
  void AddInexactResume(CLI::App& command);
  /// The options for a client. Without addresses, the client's default remains.
  client::Options ForClient() const;
};

/// A connection to the named server or, without addresses, to a server of our own that runs for the
/// lifetime of this object. Our own server loads and serves only `model` ("": the default one);
/// none: the default models.
class Connection {
 public:
  explicit Connection(const ServerOptions& options, const std::optional<std::string>& model = {});

  const client::Client& client() const { return *client_; }
  const client::ServerDescription& server() const { return server_; }
  /// The model of this name; empty: the default. Throws Error(kNotFound), naming the existing
  /// models, for an unknown name.
  const client::ModelDescription& model(const std::string& name) const;
  /// The latest failure that was retried, after a server had been reached. Thread-safe.
  std::optional<Error> failure() const;

 private:
  struct Failures;

  std::unique_ptr<authoring::LocalServer> own_;
  std::shared_ptr<Failures> failures_;
  std::unique_ptr<client::Client> client_;
  client::ServerDescription server_;
};

}  // namespace choreo::cli
