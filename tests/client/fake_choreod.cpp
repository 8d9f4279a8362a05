// A choreod with a fake engine that takes controls: takes the settings of choreod, says where it
// listens, and serves until SIGTERM.
#include <signal.h>
#include <unistd.h>

#include <iostream>
#include <memory>

#include "server/server.h"
#include "tests/support/fake_engine.h"

int main(int argc, char** argv) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  const choreo::CommandLine command_line = choreo::ParseCommandLine(argc, argv);
  if (!command_line.config) return command_line.exit_code;
  std::vector<choreo::Server::Engines> models(1);
  models[0].push_back(std::make_unique<choreo::ControlledEngine>());
  choreo::Server server(*command_line.config, std::move(models));
  std::cout << "choreod listens on 127.0.0.1:" << server.port() << std::endl;
  // Whoever waited for that line may have stopped reading; the log goes elsewhere.
  dup2(STDERR_FILENO, STDOUT_FILENO);
  int signal = 0;
  sigwait(&signals, &signal);
  return 0;
}
