#include <spdlog/spdlog.h>

#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/running/threads.h"
#include "model/engine/sampling_cost.h"
#include "model/samplers/samplers.h"
#include "server/connections/listener.h"
#include "server/model_folder.h"
#include "server/serve.h"
#include "server/server.h"
#include "server/settings/config.h"
#include "server/settings/fault_list.h"
#include "server/telemetry/log.h"

namespace choreo {
namespace {

// Warns about settings that have no effect here.
void WarnOfUnusedSettings(const ServerConfig& config, const Sampler& sampler) {
  const UsedSettings used = SettingsUsedBy(sampler);
  const std::string& name = sampler.model().name;
  if (config.engine != "auto" && !used.kind) {
    spdlog::warn("--engine {}: model \"{}\" ignores it; LibTorch runs the model", config.engine,
                 name);
  }
  if (!config.kernels.empty() && !used.kernels) {
    spdlog::warn("--kernels {}: model \"{}\" ignores it; only packed engines use it",
                 config.kernels, name);
  }
}

ModelFolder::Loader MakeLoader(const ServerConfig& config) {
  return [&config](const std::filesystem::path& path) {
    std::vector<Device> workers = ParseDevices(config.device, TorchDevices());
    // A small network cannot keep several cores busy, so each core gets a worker.
    if (const Device first = workers.front(); first.kind == Device::Kind::kCpu) {
      const int count = config.workers == 0 ? UsableCores() : config.workers;
      workers.assign(static_cast<size_t>(count), first);
    }
    std::vector<std::string> notes;
    Server::Samplers samplers =
        MakeSamplers(path, workers, ParseEngineKind(config.engine), config.kernels, &notes);
    for (const std::string& note : notes) spdlog::warn("{}: {}", path.string(), note);
    for (const auto& sampler : samplers) WarmUp(*sampler);
    const Sampler& sampler = *samplers.front();
    spdlog::info("loaded {}: model \"{}\", fingerprint {}, {} workers ({}, ...)", path.string(),
                 sampler.model().name, sampler.model().fingerprint, workers.size(),
                 sampler.device());
    WarnOfUnusedSettings(config, sampler);
    return samplers;
  };
}

void Run(const ServerConfig& config, const SettingsReader& reread) {
  HoldSignals();
  const BlasInfo blas = DetectBlas();
  const std::string warning = RequireFastBlas(blas);
  if (!warning.empty()) spdlog::warn("{}", warning);
  SetTorchThreads(config.threads);
  FlushDenormals();
  spdlog::info("BLAS {}", blas.name);

  RaiseDescriptorLimit();
  Serve(config, MakeLoader(config), reread);
}

}  // namespace
}  // namespace choreo

int main(int argc, char** argv) {
  choreo::OpenStandardStreams();
  const choreo::CommandLine command_line = choreo::ParseCommandLine(argc, argv);
  if (!command_line.config) return command_line.exit_code;
  choreo::StartLog(command_line.config->log_level, command_line.config->log_format == "json");
  try {
    choreo::Run(*command_line.config, [&] { return choreo::RereadConfig(argc, argv); });
    return 0;
  } catch (const std::exception& error) {
    for (const std::string& fault : choreo::FaultsIn(error.what()))
      spdlog::critical("{}", command_line.config->Placed(fault));
    return choreo::ExitCodeOf(error);
  }
}
