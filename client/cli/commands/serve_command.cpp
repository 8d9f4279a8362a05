#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "client/authoring/local_server.h"
#include "client/cli/commands/commands.h"
#include "model/core/error.h"
#include "network/protocol.h"

namespace choreo::cli {
namespace {

/// Becomes choreod, which then handles signals, output and exit code.
void Run(std::vector<std::string> options) {
  const auto is_port = [](const std::string& option) {
    return option == "--port" || option.starts_with("--port=");
  };
  if (std::ranges::any_of(options, is_port)) {
    throw InvalidArgument("--port",
                          "is part of --listen HOST:PORT, as in --listen 127.0.0.1:50051");
  }
  const std::string program = authoring::LocalServer::Program().string();
  std::vector<char*> arguments = {const_cast<char*>("choreod")};
  for (std::string& option : options) arguments.push_back(option.data());
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  throw Error(ErrorCode::kNotFound, program,
              std::string("cannot be started: ") + std::strerror(errno));
}

}  // namespace

void AddServeCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "serve",
      "Keep a server on this machine, so that commands with --server or CHOREO_SERVER need not "
      "start one each.\nIt prints the address at which it listens; Ctrl-C stops it. Without "
      "options that is 127.0.0.1:" +
          std::to_string(kDefaultPort) +
          ", as for commands. Takes choreod's options (choreod --help), such as:\n"
          "  --listen HOST:PORT   another address\n"
          "  --model NAME         another model, as paper-f or paper-c");
  command->prefix_command();
  command->callback([command] { Run(command->remaining()); });
}

}  // namespace choreo::cli
