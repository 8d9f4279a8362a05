#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>

#include "model/core/error.h"
#include "model/core/programs.h"
#include "model/core/threads.h"
#include "model/engine/engine_cost.h"
#include "model/engine/engines.h"
#include "server/config.h"
#include "server/listener.h"
#include "server/log.h"
#include "server/model_folder.h"
#include "server/serve.h"
#include "server/server.h"

namespace choreo {
namespace {

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

void Run(const ServerConfig& config) {
  HoldSignals();
  const BlasInfo blas = DetectBlas();
  const std::string warning = RequireFastBlas(blas);
  if (!warning.empty()) spdlog::warn("{}", warning);
  SetTorchThreads(config.threads);
  FlushDenormals();
  spdlog::info("BLAS {}", blas.name);

  RaiseDescriptorLimit();
  Serve(config, MakeLoader(config));
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
    return choreo::kFailed;
  }
}
