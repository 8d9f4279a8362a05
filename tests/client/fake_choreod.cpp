// A choreod with a fake engine that takes controls: says where it listens and serves until SIGTERM.
//   fake_choreod [--listen HOST:PORT] ...
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

  choreo::ServerConfig config;
  config.listen = argc > 2 ? argv[2] : "127.0.0.1:0";
  std::vector<choreo::Server::Engines> models(1);
  models[0].push_back(std::make_unique<choreo::ControlledEngine>());
  choreo::Server server(config, std::move(models));
  std::cout << "choreod listens on 127.0.0.1:" << server.port() << std::endl;
  // Whoever waited for that line may have stopped reading; the log goes elsewhere.
  dup2(STDERR_FILENO, STDOUT_FILENO);
  int signal = 0;
  sigwait(&signals, &signal);
  return 0;
}
