#include "model/samplers/samplers.h"

#include <torch/cuda.h>
#include <torch/types.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "model/core/error.h"
#include "model/core/running/threads.h"
#include "model/core/text/printable.h"
#include "model/engine/loading.h"
#include "model/engine/packed/packed_flow_network.h"
#include "model/flow/checkpoint/style_figures_file.h"
#include "model/flow/flow_sampler.h"
#include "model/flow/network/continuous_flow.h"
#include "model/flow/network/torch_kernels.h"
#include "model/papers/samplers/paper_samplers.h"

namespace choreo {
namespace {

/// A model dances as well without its figures, so a fault in their file is but a note.
std::optional<StyleFigures> FiguresOf(const std::filesystem::path& checkpoint,
                                      const std::string& hash, std::vector<std::string>* notes) {
  try {
    return ReadStyleFigures(checkpoint, hash);
  } catch (const Error& error) {
    const std::string note = Printable(error.what()) + "; its styles count as unmeasured";
    if (notes && std::ranges::find(*notes, note) == notes->end()) notes->push_back(note);
    return std::nullopt;
  }
}

SamplerFactory LoadContinuousFlow(const Safetensors& content, const std::filesystem::path& path,
                                  const EngineRequest& request) {
  const ContinuousFlowCheckpoint checkpoint = ParseContinuousFlow(content, path.string());
  const ContinuousFlowConfig& config = checkpoint.model->config();
  const auto parts = std::make_shared<const FlowModelParts>(checkpoint.model->Parts());
  std::shared_ptr<const FlowNetwork> network;
  UsedKernels kernels;
  if (const auto set = ChooseKernels(request)) {
    kernels.packed = set->products->name;
    network = std::make_shared<const PackedFlowNetwork>(
        content, config, checkpoint.model->skeleton(), *set->exact, *set->products);
  } else {
    const torch::Device there(request.device.name());
    kernels.torch = TorchKernels(there);
    network = MakeTorchFlowNetwork(checkpoint.model, there);
  }
  ModelInfo info = InfoOf(checkpoint, kernels);
  info.sight_frames = kSightFrames;
  info.default_temperature = config.temperature;
  info.max_temperature = kMaxFlowTemperature;
  info.controls = ControlNames();
  info.velocity_references = {MedianReference(config.median_factors)};
  info.styles = config.styles;
  info.style_figures = FiguresOf(path, checkpoint.hash, request.notes);
  info.plan_stages = true;
  info.plan_options = config.plan;
  return [info, device = request.device.name(), parts, network] {
    return std::make_unique<ContinuousFlowSampler>(info, device, parts, network);
  };
}

constexpr uintmax_t kMaxBytes = uintmax_t{1} << 30;  // of a checkpoint

void CheckName(const std::string& name, const std::filesystem::path& path) {
  if (!name.empty() && name.size() <= kMaxNameBytes && Printable(name) == name) return;
  throw InvalidArgument(
      path.string(), "the model's name, \"" + Printable(name.substr(0, kMaxNameBytes)) +
                         "\", is not 1 to " + std::to_string(kMaxNameBytes) + " printable bytes");
}

// Every error names the file.
SamplerFactory Load(const std::filesystem::path& path, const EngineRequest& request) try {
  const c10::InferenceMode inference;
  // Exact float32 everywhere: reproducible bits before speed.
  at::globalContext().setAllowTF32CuBLAS(false);
  at::globalContext().setAllowTF32CuDNN(false);
  at::globalContext().setDeterministicCuDNN(true);
  // Somebody who may put a file there must not exhaust the server's memory.
  std::error_code none;
  if (const auto bytes = std::filesystem::file_size(path, none); !none && bytes > kMaxBytes) {
    throw InvalidArgument(
        path.string(), std::to_string(bytes) + " bytes, the limit is " + std::to_string(kMaxBytes));
  }
  const Safetensors content = ReadSafetensors(path);
  return HoldsContinuousFlow(content) ? LoadContinuousFlow(content, path, request)
                                      : LoadPaperModel(content, path.string(), request);
} catch (const Error& error) {
  if (error.field().starts_with(path.string())) throw;
  throw Error(error.code(), path.string(), error.what());
} catch (const std::bad_alloc&) {
  throw Error(ErrorCode::kResourceExhausted, path.string(), "there is no memory for it");
}

}  // namespace

AvailableDevices TorchDevices() {
  return {.cuda_build = at::hasCUDA(),
          .cuda_devices = static_cast<int>(torch::cuda::device_count())};
}

void SetTorchThreads(int threads) {
  SetMathThreads(threads);
  at::set_num_threads(threads);
}

std::vector<std::unique_ptr<Sampler>> MakeSamplers(const std::filesystem::path& path,
                                                   std::span<const Device> devices, EngineKind kind,
                                                   const std::string& kernels,
                                                   std::vector<std::string>* notes) {
  std::map<Device, SamplerFactory> loaded;
  std::vector<std::unique_ptr<Sampler>> samplers;
  for (const Device& device : devices) {
    const auto [here, is_new] = loaded.try_emplace(device);
    if (is_new) here->second = Load(path, {device, kind, kernels, notes});
    samplers.push_back(here->second());
    CheckName(samplers.back()->model().name, path);
  }
  return samplers;
}

UsedSettings SettingsUsedBy(const Sampler& sampler) {
  // A deterministic sampler is not a flow.
  return {.kind = !sampler.model().deterministic,
          .kernels = !sampler.model().packed_kernels.empty()};
}

std::unique_ptr<Sampler> MakeSampler(const std::filesystem::path& checkpoint, const Device& device,
                                     EngineKind kind) {
  return std::move(MakeSamplers(checkpoint, {&device, 1}, kind).front());
}

}  // namespace choreo
