#include <iostream>
#include <memory>

#include "client/cli/commands/commands.h"
#include "client/cli/options/connection.h"

namespace choreo::cli {
namespace {

/// Throws unless the server is serving. For programs that start, monitor and replace servers.
void Run(const ServerOptions& server, bool any_certificate) {
  client::Options options = server.ForClient();
  options.retry_s = 0;
  options.token_file.clear();  // health checks need no token
  options.any_certificate = any_certificate;
  if (!client::Client(options).IsServing()) {
    throw Error(ErrorCode::kUnavailable, options.addresses.front(),
                "does not serve: it drains, or the engine of a model fails");
  }
  std::cout << "serving" << std::endl;
}

}  // namespace

void AddHealthCommand(CLI::App& program) {
  auto options = std::make_shared<ServerOptions>();
  options->deadline_s = 3;
  CLI::App* command = program.add_subcommand(
      "health", "Ask a server once whether it serves; fails if it does not.");
  options->AddTo(*command);
  command->get_option("--server")
      ->description("HOST:PORT of the choreod; default: " + client::Options().addresses.front() +
                    ".");
  command->get_option("--token-file")->group("");  // kept for scripts that set it
  command->get_option("--deadline")->description("Give up after this many seconds; 0: never.");
  auto any_certificate = std::make_shared<bool>(false);
  command->add_flag(
      "--any-certificate", *any_certificate,
      "With --tls, accept any certificate, even an expired one: a restart would not mend it.");
  command->callback([options, any_certificate] { Run(*options, *any_certificate); });
}

}  // namespace choreo::cli
