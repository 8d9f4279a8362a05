#include <pthread.h>
#include <signal.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "model/core/error.h"
#include "model/core/threads.h"
#include "model/engine/devices.h"
#include "model/engine/engines.h"
#include "model/engine/warm_up.h"
#include "server/config.h"
#include "server/listener.h"
#include "server/log.h"
#include "server/model_folder.h"
#include "server/server.h"

namespace choreo {
namespace {

pthread_t waits_for_signals;

/// Stops these from ending the process: from here on they wait for sigwait, on this thread. Threads
/// that begin later inherit it; those that libraries began before main don't, so they hand on what
/// reaches them.
// Also lets a log whose reader is gone be a log that nobody reads.
sigset_t BlockSignals() {
  signal(SIGPIPE, SIG_IGN);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  waits_for_signals = pthread_self();
  for (const int one : {SIGTERM, SIGINT, SIGHUP})
    signal(one, [](int reached) { pthread_kill(waits_for_signals, reached); });
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

ModelFolder::Loader MakeLoader(const ServerConfig& config) {
  const std::vector<Device> devices = ParseDevices(config.device, TorchDevices());
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
  return [&config, workers, slots](const std::filesystem::path& path) {
    Server::Engines engines =
        MakeEngines(path, workers, slots, ParseEngineKind(config.engine), config.kernels);
    for (const auto& engine : engines) WarmUp(*engine);
    const StepEngine& engine = *engines.front();
    spdlog::info("loaded {}: model \"{}\", fingerprint {}, {} workers ({}, ...) of {} slots",
                 path.string(), engine.model().name, engine.model().fingerprint, workers.size(),
                 engine.device(), slots);
    WarnOfUnheeded(config, engine);
    return engines;
  };
}

/// Reads the folder of models again whenever somebody asks, on a thread of its own: loading takes
/// seconds, in which signals are heard. Who asks meanwhile is served by one more look.
class Reloader {
 public:
  Reloader(ModelFolder& folder, Server& server)
      : thread_([this, &folder, &server](const std::stop_token& stop) {
          std::unique_lock lock(mutex_);
          while (wake_.wait(lock, stop, [this] { return asked_; })) {
            asked_ = false;
            lock.unlock();
            folder.Reload(server, [&stop] { return stop.stop_requested(); });
            lock.lock();
          }
        }) {}

  void Ask() {
    const std::lock_guard lock(mutex_);
    asked_ = true;
    wake_.notify_one();
  }
  /// Of what is asked nothing more is done.
  void Stop() { thread_.request_stop(); }

 private:
  std::mutex mutex_;
  std::condition_variable_any wake_;
  bool asked_ = false;   // lock: mutex_
  std::jthread thread_;  // last: it uses the above
};

void Run(const ServerConfig& config) {
  const sigset_t signals = BlockSignals();
  const BlasInfo blas = DetectBlas();
  const std::string warning = RequireFastBlas(blas);
  if (!warning.empty()) spdlog::warn("{}", warning);
  SetTorchThreads(config.threads);
  FlushDenormals();
  spdlog::info("BLAS {}", blas.name);

  RaiseDescriptorLimit();
  const ModelFolder::Loader load = MakeLoader(config);
  ModelFolder folder(config.models, load);
  const bool has_folder = !config.models.empty();
  std::vector<Server::Engines> models;
  if (has_folder) {
    models = folder.Load();
  } else {
    for (const auto& path : config.checkpoints.empty() ? ShippedCheckpoints() : config.checkpoints)
      models.push_back(load(path));
  }
  Server server(config, std::move(models));
  Reloader reloader(folder, server);
  const std::string host = config.listen.substr(0, config.listen.rfind(':'));
  // Whoever starts a choreod waits for this line.
  std::cout << "choreod listens on " << host << ':' << server.port() << std::endl;

  int signal = 0;
  while (sigwait(&signals, &signal) == 0 && signal == SIGHUP && has_folder) reloader.Ask();
  spdlog::info("{}: draining for up to {} s; again to leave at once", strsignal(signal),
               config.drain_seconds);
  reloader.Stop();
  for (const int one : {SIGTERM, SIGINT}) ::signal(one, SIG_DFL);
  // Whoever has models read anew does not mean to end the calls that are left.
  ::signal(SIGHUP, has_folder ? SIG_IGN : SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
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
