#include "client/cli/options/connection.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "client/cli/options/interruption.h"
#include "client/cli/options/options.h"
#include "model/core/joined.h"
#include "model/core/programs.h"
#include "model/core/rounded.h"

namespace choreo::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kOfOneLoss{5};
/// A command that waits longer for a server says so. One that is just starting is there earlier.
constexpr std::chrono::milliseconds kSilent{500};
constexpr const char* kServerVariable = "CHOREO_SERVER";

/// Adds, to the error for an unreachable server, where its address comes from.
Error Explained(const Error& error, const std::vector<std::string>& addresses) {
  const char* variable = std::getenv(kServerVariable);
  if (error.code() != ErrorCode::kUnavailable || variable == nullptr) return error;
  if (std::ranges::find(addresses, variable) == addresses.end()) return error;
  return {error.code(), "",
          std::string(error.what()) + "; " + kServerVariable +
              " names it: start one there (choreo serve), or unset " + kServerVariable};
}

}  // namespace

void ServerOptions::AddTo(CLI::App& command) {
  AddRepeated(command, "--server", addresses,
              "HOST:PORT of a choreod. Repeatable: several are replicas of each other. Without it, "
              "the command starts a server on this machine, and stops it at the end.")
      ->envname(kServerVariable);
  command.add_flag("--tls", tls, "Encrypt the connection.")->envname("CHOREO_TLS");
  command
      .add_option("--ca", ca_certificate,
                  "PEM file of the trusted authority, with --tls. Default: the system's.")
      ->envname("CHOREO_CA");
  command
      .add_option("--client-cert", client_certificate,
                  "PEM file of the certificate to show to the server, with --tls.")
      ->envname("CHOREO_CLIENT_CERT");
  command.add_option("--client-key", client_key, "PEM file with the private key of --client-cert.")
      ->envname("CHOREO_CLIENT_KEY");
  command
      .add_option(
          "--server-name", server_name,
          "The name that the server's certificate must have, with --tls. Default: the address's.")
      ->envname("CHOREO_SERVER_NAME");
  command
      .add_option(
          "--token-file", token_file,
          "File with the token for the server. It is sent only over TLS, or to this machine.")
      ->envname("CHOREO_TOKEN_FILE");
  command
      .add_option("--deadline", deadline_s,
                  "Give up after this many seconds; 0: never. A server that is full or away is "
                  "tried again for 10 s, or for as long as this if it is longer.")
      ->check(TimeInSeconds())
      ->capture_default_str();
}

void ServerOptions::AddInexactResume(CLI::App& command) {
  command.add_flag(
      "--allow-inexact-resume", allow_inexact_resume,
      "If the server is lost and only another model or build is left, continue with that.");
}

client::Options ServerOptions::ForClient() const {
  client::Options options;
  if (!addresses.empty()) options.addresses = addresses;
  options.tls = tls;
  options.ca_certificate = ca_certificate;
  options.client_certificate = client_certificate;
  options.client_key = client_key;
  options.server_name = server_name;
  options.token_file = token_file;
  options.deadline_s = deadline_s;
  // Who can wait longer than usual may be asked to by a full server.
  options.retry_s = std::max(options.retry_s, deadline_s);
  options.allow_inexact_resume = allow_inexact_resume;
  options.even_draining = even_draining;
  return options;
}

struct Connection::Failures {
  Failures(double seconds, std::vector<std::string> of)
      : retry_s(seconds), addresses(std::move(of)) {}

  /// Prints a note for each loss of a server, once, and one if no server was ever reached.
  void Note(const std::string& address, const Error& failure) {
    const std::lock_guard lock(mutex);
    if (!reached) {
      if (waits || Clock::now() - begun < kSilent) return;
      waits = true;
      std::cerr << "note: " << Explained(failure.Of(address), addresses).what()
                << "; trying for up to " << Rounded(retry_s) << " s\n";
      return;
    }
    latest = failure;
    // Retries are at most seconds apart; later failures are another loss.
    const Clock::time_point before = std::exchange(noted[address], Clock::now());
    if (noted[address] - before <= kOfOneLoss) return;
    std::cerr << "note: " << failure.Of(address).what() << "; retrying for up to "
              << Rounded(retry_s) << " s\n";
  }

  const double retry_s;
  const std::vector<std::string> addresses;
  const Clock::time_point begun = Clock::now();
  bool waits = false;  // lock: mutex
  std::atomic<bool> reached = false;
  std::mutex mutex;
  std::optional<Error> latest;                     // lock: mutex
  std::map<std::string, Clock::time_point> noted;  // by address; lock: mutex
};

Connection::Connection(const ServerOptions& options, const std::optional<std::string>& model) {
  client::Options client_options = options.ForClient();
  if (options.addresses.empty()) {
    std::cerr << "note: starting a server for this command alone, which takes seconds; to keep "
                 "one: choreo serve, and CHOREO_SERVER="
              << client_options.addresses.front() << " for commands\n";
    own_ = authoring::LocalServer::Start(!model           ? std::string()
                                         : model->empty() ? std::string(kShippedModels[0])
                                                          : *model);
    client_options.addresses = {own_->address()};
    // These settings, which may come from the environment, are for other servers.
    client_options.tls = false;
    client_options.token_file.clear();
  }
  client_options.before_retry = [own = own_.get()] {
    Interruption::Check();
    if (own) own->RequireRunning();
  };
  const double patience_s = options.deadline_s > 0 ? options.deadline_s : client_options.retry_s;
  failures_ = std::make_shared<Failures>(patience_s, options.addresses);
  client_options.retried = [failures = failures_](const std::string& address,
                                                  const Error& failure) {
    failures->Note(address, failure);
  };
  client_ = std::make_unique<client::Client>(client_options);
  try {
    server_ = client_->GetServerInfo();
  } catch (const Error& error) {
    throw Explained(error, options.addresses);
  }
  failures_->reached = true;
}

std::optional<Error> Connection::failure() const {
  const std::lock_guard lock(failures_->mutex);
  return failures_->latest;
}

const client::ModelDescription& Connection::model(const std::string& name) const {
  if (name.empty()) return server_.models.front();
  const auto found =
      std::find_if(server_.models.begin(), server_.models.end(),
                   [&](const client::ModelDescription& model) { return model.name == name; });
  if (found != server_.models.end()) return *found;
  if (name == kFormerControls) {
    std::cerr << "warning: --model: \"" << name << "\" is now another name of \""
              << server_.models.front().name << "\"\n";
    return server_.models.front();
  }
  throw Error(ErrorCode::kNotFound, "--model",
              "the server has no \"" + name + "\", but " +
                  Joined(server_.models, &client::ModelDescription::name) +
                  "; choreo serve --model NAME starts one with another, as paper-f or paper-c");
}

}  // namespace choreo::cli
