#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/choreo_client.h"
#include "client/cli/local_server.h"

namespace choreo::cli {

/// The options that every command has which needs a server.
struct ServerOptions {
  std::vector<std::string> addresses;
  bool tls = false;
  std::string ca_certificate, client_certificate, client_key, server_name, token_file;
  double deadline_s = 0;
  bool allow_inexact_resume = false;
  bool even_draining = false;

  void AddTo(CLI::App& command);
  /// Addresses that were not named are the client's own default.
  client::Options ForClient() const;
};

/// The server that was named, or else one of our own for as long as this lives. That one serves
/// `model` alone ("": the default), so that it loads no other; none: those for every day.
class Connection {
 public:
  explicit Connection(const ServerOptions& options, const std::optional<std::string>& model = {});

  const client::Client& client() const { return *client_; }
  const client::ServerDescription& server() const { return server_; }
  /// By name; the server's default where it is empty. Throws Error(kNotFound) naming those that
  /// there are.
  const client::ModelDescription& model(const std::string& name) const;

 private:
  std::unique_ptr<LocalServer> own_;
  std::unique_ptr<client::Client> client_;
  client::ServerDescription server_;
};

}  // namespace choreo::cli
