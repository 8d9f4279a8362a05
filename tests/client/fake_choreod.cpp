// A choreod with a fake engine: says where it listens and serves until SIGTERM.
#include <signal.h>

#include <iostream>
#include <memory>

#include "server/server.h"
#include "tests/support/fake_engine.h"

int main() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  choreo::ServerConfig config;
  config.listen = "127.0.0.1:0";
  std::vector<choreo::Server::Engines> models(1);
  models[0].push_back(std::make_unique<choreo::FakeEngine>());
  choreo::Server server(config, std::move(models));
  std::cout << "choreod listens on 127.0.0.1:" << server.port() << std::endl;
  int signal = 0;
  sigwait(&signals, &signal);
  return 0;
}
