#include "model/engine/samplers.h"

#include <ATen/Parallel.h>
#include <ATen/Version.h>
#include <ATen/detail/CUDAHooksInterface.h>
#include <torch/cuda.h>
#include <torch/torch.h>

#include <functional>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "model/controllers/checkpoint.h"
#include "model/core/error.h"
#include "model/core/math_library.h"
#include "model/core/printable.h"
#include "model/core/threads.h"
#include "model/engine/autoregressive_flow.h"
#include "model/engine/continuous_flow_sampler.h"
#include "model/engine/packed/continuous_flow.h"
#include "model/engine/packed/flow.h"
#include "model/engine/packed/kernels.h"
#include "model/engine/torch/controllers_sampler.h"
#include "model/engine/torch/inbetweener_tile.h"
#include "model/engine/torch/tile.h"
#include "model/flow/checkpoint.h"
#include "model/flow/continuous_flow.h"
#include "model/flow/inbetweener.h"

namespace choreo {
namespace {

/// Of the kernels in a fingerprint, where they are our own.
constexpr const char* kPackedPrefix = "packed ";

// What LibTorch's own kernels were chosen for, as in "AVX512"; empty if it doesn't tell.
std::string CpuCapability() {
  const std::string config = at::show_config();
  const std::string key = "CPU capability usage: ";
  const size_t at = config.find(key);
  if (at == std::string::npos) return "";
  const size_t begin = at + key.size();
  return config.substr(begin, config.find('\n', begin) - begin);
}

// Everything that can change a bit of what LibTorch computes, but for the weights.
std::string TorchKernels(const torch::Device& device) {
  const std::string torch = "torch " TORCH_VERSION ", ";
  if (device.is_cuda()) {  // a list, of which a fingerprint has one line
    std::istringstream words(at::detail::getCUDAHooks().showConfig());
    std::string cuda;
    for (std::string word; words >> word;) cuda += word == "-" ? ", " : word + " ";
    return torch + device.str() + cuda;
  }
  return torch + DetectBlas().name + ", " + CpuCapability() + ", " +
         std::to_string(at::get_num_threads()) + " threads";
}

std::string LicenceOf(const std::string& card) {
  const auto json = nlohmann::json::parse(card, nullptr, /*allow_exceptions=*/false);
  return json.is_object() ? json.value("licence", "") : "";
}

struct KernelSet {
  const PackedKernels* exact;
  /// Of the networks: the exact ones, or those of bfloat16, whose dances have the same figures
  /// (docs/decisions.md, 32).
  const PackedKernels* products;

  std::string Name() const { return kPackedPrefix + std::string(products->name); }
};

// What this machine and this engine have, fastest first.
std::vector<KernelSet> KernelSetsHere(EngineKind kind) {
  std::vector<KernelSet> sets;
  if (kind != EngineKind::kPacked) {
    for (const PackedKernels* bf16 : Bf16KernelsHere())
      sets.push_back({PackedKernelsHere().front(), bf16});
  }
  if (kind == EngineKind::kPackedBf16) return sets;
  for (const PackedKernels* kernels : PackedKernelsHere()) sets.push_back({kernels, kernels});
  return sets;
}

// What a flow is computed with: the fastest that keep rows apart, or those of this name, where
// there is one. None: LibTorch does it.
std::optional<KernelSet> ChooseKernels(EngineKind kind, const Device& device,
                                       const std::string& name) {
  const bool on_cpu = device.kind == Device::Kind::kCpu;
  if (kind == EngineKind::kTorch || (kind == EngineKind::kAuto && !on_cpu)) return std::nullopt;
  if (!on_cpu)
    throw InvalidArgument("engine", "packed computes on the CPU, not on " + device.name());
  const std::vector<KernelSet> here = KernelSetsHere(kind);
  if (here.empty()) {
    throw InvalidArgument("engine", "packed-bf16 needs a CPU with AVX512-BF16, which this is not");
  }
  std::string known;
  bool found = false;
  for (const KernelSet& set : here) {
    known += (known.empty() ? "" : ", ") + std::string(set.products->name);
    if (!name.empty() && name != set.products->name) continue;
    found = true;
    if (RowsAreIndependent(*set.exact) && RowsAreIndependent(*set.products)) return set;
    std::clog << "choreo: with " << set.products->name << " a row's bits depend on its batch\n";
  }
  if (!found) throw InvalidArgument("kernels", '"' + name + "\" is none of " + known);
  throw Error(ErrorCode::kInternal, "", "no kernel of the packed engine keeps rows apart here");
}

// What is the same of every checkpoint.
template <typename Model>
ModelInfo InfoOf(const CheckpointOf<Model>& checkpoint, const std::string& kernels) {
  const auto& config = checkpoint.model->config();
  return {.name = config.name,
          .fingerprint = config.name + "/" + checkpoint.hash + "/choreo " CHOREO_VERSION + ", " +
                         BuildIdentity() + ", " + MathLibrary() + "/" + kernels,
          .licence = LicenceOf(checkpoint.card),
          .card = checkpoint.card,
          .skeleton = checkpoint.model->skeleton(),
          .history_frames = config.history_frames,
          .max_transition_frames = config.max_transition_frames,
          .velocity_references = {}};
}

VelocityReference Median(const auto& factors) {
  VelocityReference median{.name = "median"};
  std::ranges::copy(factors, median.factors.begin());
  return median;
}

// Makes samplers that share one device's weights.
using Factory = std::function<std::unique_ptr<Sampler>()>;

// It is small: whatever samples flows elsewhere, this runs on the CPU.
Factory LoadControllers(const Safetensors& content, const std::filesystem::path& path) {
  const ControllersCheckpoint checkpoint = ParseControllers(content, path.string());
  const ControllersConfig& config = checkpoint.model->config();
  ModelInfo info = InfoOf(checkpoint, TorchKernels(torch::Device(torch::kCPU)));
  info.audio_features = 0;  // it hears no music
  info.hears_music = false;
  info.default_temperature = 0;
  info.deterministic = true;
  info.root_path = true;
  info.velocity_factors = config.velocity_factors;
  info.velocity_references = {Median(checkpoint.median_factors)};
  return [info, model = checkpoint.model] {
    return std::make_unique<ControllersSampler>(info, model);
  };
}

Factory LoadContinuousFlow(const Safetensors& content, const std::filesystem::path& path,
                           const Device& device, EngineKind kind, const std::string& kernel_name) {
  const ContinuousFlowCheckpoint checkpoint = ParseContinuousFlow(content, path.string());
  const ContinuousFlowConfig& config = checkpoint.model->config();
  const auto parts = std::make_shared<const FlowModelParts>(checkpoint.model->Parts());
  std::shared_ptr<const FlowNetwork> network;
  std::string kernels;
  if (const auto set = ChooseKernels(kind, device, kernel_name)) {
    kernels = set->Name();
    network = std::make_shared<const PackedFlowNetwork>(
        content, config, checkpoint.model->skeleton(), *set->exact, *set->products);
  } else {
    const torch::Device there(device.name());
    kernels = TorchKernels(there);
    network = MakeTorchFlowNetwork(checkpoint.model, there);
  }
  ModelInfo info = InfoOf(checkpoint, kernels);
  info.hears_music = false;  // but its beats
  info.default_temperature = config.temperature;
  info.max_temperature = kMaxFlowTemperature;
  info.root_path = info.velocity_factors = true;
  info.velocity_references = {Median(config.median_factors)};
  info.styles = config.styles;
  info.footwork = config.plan.footwork;
  return [info, device, parts, network] {
    return std::make_unique<ContinuousFlowSampler>(info, device.name(), parts, network);
  };
}

Factory LoadFlow(const Safetensors& content, const std::filesystem::path& path,
                 const Device& device, EngineKind kind, const std::string& kernel_name) {
  const Checkpoint checkpoint = ParseCheckpoint(content, path.string());
  FlowModel model = checkpoint.model;
  const FlowConfig& config = model->config();
  AutoregressiveFlowSampler::MakeTile tile;
  std::string kernels;
  if (const auto set = ChooseKernels(kind, device, kernel_name)) {
    kernels = set->Name();
    const auto packed = std::make_shared<const PackedFlow>(content, config, model->skeleton(),
                                                           *set->exact, *set->products);
    tile = [packed] { return std::make_unique<PackedTile>(packed, 1); };
  } else {
    const torch::Device there(device.name());
    model->to(there);
    const auto weights =
        std::make_shared<TorchWeights>(TorchWeights{model, model->InverseWeights(), there});
    kernels = TorchKernels(weights->device);
    tile = [weights] { return std::make_unique<TorchTile>(weights, 1); };
  }
  ModelInfo info = InfoOf(checkpoint, kernels);
  info.audio_features = config.audio_features;
  info.hears_music = config.hears_music;
  info.default_temperature = config.temperature;
  return [info, config, device, tile] {
    return std::make_unique<AutoregressiveFlowSampler>(info, config, device.name(), tile);
  };
}

// As small, and run likewise.
Factory LoadInbetweener(const Safetensors& content, const std::filesystem::path& path) {
  const InbetweenerCheckpoint checkpoint = ParseInbetweener(content, path.string());
  ModelInfo info = InfoOf(checkpoint, TorchKernels(torch::Device(torch::kCPU)));
  info.hears_music = false;
  info.default_temperature = 0;
  info.deterministic = true;
  return [info, model = checkpoint.model] {
    return std::make_unique<AutoregressiveFlowSampler>(info, model->config(), "cpu", [model] {
      return std::make_unique<InbetweenerTile>(model, 1);
    });
  };
}

constexpr uintmax_t kMostBytes = uintmax_t{1} << 30;  // of a checkpoint

void CheckName(const std::string& name, const std::filesystem::path& path) {
  if (!name.empty() && name.size() <= kMostNameBytes && Printable(name) == name) return;
  throw InvalidArgument(
      path.string(), "the model's name, \"" + Printable(name.substr(0, kMostNameBytes)) +
                         "\", is not 1 to " + std::to_string(kMostNameBytes) + " printable bytes");
}

// Every error says which file it is about.
Factory Load(const std::filesystem::path& path, const Device& device, EngineKind kind,
             const std::string& kernel_name) try {
  const c10::InferenceMode inference;
  // Exact float32 everywhere: bits before speed.
  at::globalContext().setAllowTF32CuBLAS(false);
  at::globalContext().setAllowTF32CuDNN(false);
  at::globalContext().setDeterministicCuDNN(true);
  // Whoever may put a file there must not take the memory of who serves.
  std::error_code none;
  if (const auto bytes = std::filesystem::file_size(path, none); !none && bytes > kMostBytes) {
    throw InvalidArgument(path.string(), std::to_string(bytes) + " bytes, the limit is " +
                                             std::to_string(kMostBytes));
  }
  const Safetensors content = ReadSafetensors(path);
  if (HoldsControllers(content)) return LoadControllers(content, path);
  if (HoldsInbetweener(content)) return LoadInbetweener(content, path);
  if (HoldsContinuousFlow(content))
    return LoadContinuousFlow(content, path, device, kind, kernel_name);
  return LoadFlow(content, path, device, kind, kernel_name);
} catch (const Error& error) {
  if (std::string_view(error.what()).find(path.string()) != std::string_view::npos) throw;
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
                                                   const std::string& kernels) {
  std::map<Device, Factory> loaded;
  std::vector<std::unique_ptr<Sampler>> samplers;
  for (const Device& device : devices) {
    const auto [here, is_new] = loaded.try_emplace(device);
    if (is_new) here->second = Load(path, device, kind, kernels);
    samplers.push_back(here->second());
    CheckName(samplers.back()->model().name, path);
  }
  return samplers;
}

Heeded HeededBy(const Sampler& sampler) {
  // Who draws nothing is no flow.
  return {.kind = !sampler.model().deterministic,
          .kernels = sampler.model().fingerprint.find(kPackedPrefix) != std::string::npos};
}

std::unique_ptr<Sampler> MakeSampler(const std::filesystem::path& checkpoint, const Device& device,
                                     EngineKind kind) {
  return std::move(MakeSamplers(checkpoint, {&device, 1}, kind).front());
}

}  // namespace choreo
