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
  /// Adds the flag to commands whose dances outlive a server.
  void AddInexactResume(CLI::App& command);
  /// Uses the client's default without addresses.
  client::Options ForClient() const;
};

/// The named server, or else our own for the lifetime of this object, which serves only `model`
/// ("": the default) to load no other; none: the default ones.
class Connection {
 public:
  explicit Connection(const ServerOptions& options, const std::optional<std::string>& model = {});

  const client::Client& client() const { return *client_; }
  const client::ServerDescription& server() const { return server_; }
  /// The model of this name, or the default. Throws Error(kNotFound) naming the existing ones.
  const client::ModelDescription& model(const std::string& name) const;
  /// The latest failure of a server, once reached, that another attempt followed. Thread-safe.
  std::optional<Error> failure() const;

 private:
  struct Failures;

  std::unique_ptr<authoring::LocalServer> own_;
  std::shared_ptr<Failures> failures_;
  std::unique_ptr<client::Client> client_;
  client::ServerDescription server_;
};

}  // namespace choreo::cli
