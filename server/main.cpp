#include <pthread.h>
#include <signal.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iostream>
#include <string>

#include "model/core/error.h"
#include "model/core/threads.h"
#include "model/engine/devices.h"
#include "model/engine/engines.h"
#include "model/engine/warm_up.h"
#include "server/config.h"
#include "server/listener.h"
#include "server/log.h"
#include "server/server.h"

namespace choreo {
namespace {

/// Stops these from ending the process: from here on they wait for sigwait. Threads inherit it.
// Also lets a log whose reader is gone be a log that nobody reads.
sigset_t BlockStopSignals() {
  signal(SIGPIPE, SIG_IGN);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

// Of settings that change nothing; whoever says them expects something of them.
void WarnOfUnheeded(const ServerConfig& config, const StepEngine& engine) {
  const Heeded heeded = HeededBy(engine);
  const std::string& name = engine.model().name;
  if (config.engine != "auto" && !heeded.kind) {
    spdlog::warn("--engine {}: model \"{}\" does not heed it; LibTorch runs it", config.engine,
                 name);
  }
  if (!config.kernels.empty() && !heeded.kernels) {
    spdlog::warn("--kernels {}: model \"{}\" does not heed it; it concerns packed engines",
                 config.kernels, name);
  }
}

std::vector<Server::Engines> LoadModels(const ServerConfig& config) {
  const std::vector<Device> devices = ParseDevices(config.device, TorchDevices());
  std::vector<std::filesystem::path> checkpoints = config.checkpoints;
  if (checkpoints.empty()) checkpoints = ShippedCheckpoints();
  // One small network does not keep several cores busy: each gets a worker, with its share of the
  // slots.
  std::vector<Device> workers = devices;
  int slots = config.Slots();
  if (devices.front().kind == Device::Kind::kCpu) {
    const int wanted = config.workers == 0 ? UsableCores() : config.workers;
    const int count = std::min(wanted, config.Slots());
    workers.assign(static_cast<size_t>(count), devices.front());
    slots = (config.Slots() + count - 1) / count;
  }
  std::vector<Server::Engines> models;
  for (const auto& path : checkpoints) {
    models.push_back(
        MakeEngines(path, workers, slots, ParseEngineKind(config.engine), config.kernels));
    for (const auto& engine : models.back()) WarmUp(*engine);
    const StepEngine& engine = *models.back().front();
    spdlog::info("loaded {}: model \"{}\", fingerprint {}, {} workers ({}, ...) of {} slots",
                 path.string(), engine.model().name, engine.model().fingerprint, workers.size(),
                 engine.device(), slots);
    WarnOfUnheeded(config, engine);
  }
  return models;
}

void Run(const ServerConfig& config) {
  const sigset_t stop_signals = BlockStopSignals();
  const BlasInfo blas = DetectBlas();
  const std::string warning = RequireFastBlas(blas);
  if (!warning.empty()) spdlog::warn("{}", warning);
  SetTorchThreads(config.threads);
  FlushDenormals();
  spdlog::info("BLAS {}", blas.name);

  RaiseDescriptorLimit();
  Server server(config, LoadModels(config));
  const std::string host = config.listen.substr(0, config.listen.rfind(':'));
  // Whoever starts a choreod waits for this line.
  std::cout << "choreod listens on " << host << ':' << server.port() << std::endl;

  int signal = 0;
  sigwait(&stop_signals, &signal);
  spdlog::info("{}: draining for up to {} s; again to leave at once", strsignal(signal),
               config.drain_seconds);
  pthread_sigmask(SIG_UNBLOCK, &stop_signals, nullptr);
  server.Drain(config.drain_seconds);
}

}  // namespace
}  // namespace choreo

int main(int argc, char** argv) {
  const choreo::CommandLine command_line = choreo::ParseCommandLine(argc, argv);
  if (!command_line.config) return command_line.exit_code;
  choreo::StartLog(command_line.config->log_level, command_line.config->log_format == "json");
  try {
    choreo::Run(*command_line.config);
    return 0;
  } catch (const std::exception& error) {
    spdlog::critical("{}", error.what());
    return 1;
  }
}
