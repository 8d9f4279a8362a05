#include "model/engine/engines.h"

#include <ATen/Parallel.h>
#include <ATen/Version.h>
#include <torch/cuda.h>
#include <torch/torch.h>

#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "model/controllers/checkpoint.h"
#include "model/core/error.h"
#include "model/core/threads.h"
#include "model/engine/build_identity.h"
#include "model/engine/continuous_flow_engine.h"
#include "model/engine/controllers_engine.h"
#include "model/engine/device_graph.h"
#include "model/engine/flow_engine.h"
#include "model/engine/packed_flow.h"
#include "model/engine/packed_kernels.h"
#include "model/engine/packed_planner.h"
#include "model/engine/packed_tile.h"
#include "model/engine/torch_planner.h"
#include "model/engine/torch_tile.h"
#include "model/flow/checkpoint.h"
#include "model/flow/continuous_flow.h"

namespace choreo {
namespace {

torch::Device ToTorch(const Device& device) {
  return device.kind == Device::Kind::kCpu
             ? torch::Device(torch::kCPU)
             : torch::Device(torch::kCUDA, static_cast<torch::DeviceIndex>(device.index));
}

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
  if (device.is_cuda()) return torch + DescribeCuda(device);
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
};

// What this machine and this engine have, fastest first.
std::vector<KernelSet> KernelSetsHere(EngineKind kind) {
  std::vector<KernelSet> sets;
  if (const PackedKernels* bf16 = Bf16KernelsHere(); bf16 && kind != EngineKind::kPacked) {
    sets.push_back({PackedKernelsHere().front(), bf16});
  }
  if (kind == EngineKind::kPackedBf16) return sets;
  for (const PackedKernels* kernels : PackedKernelsHere()) sets.push_back({kernels, kernels});
  return sets;
}

// The fastest that keep rows apart; those of this name, where there is one.
KernelSet ChooseKernels(EngineKind kind, const std::string& name) {
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

std::string Fingerprint(const std::string& preset, const std::string& hash,
                        const std::string& kernels) {
  return preset + "/" + hash + "/choreo " CHOREO_VERSION + ", " + BuildIdentity() + "/" + kernels;
}

// What the engines of one device share.
struct Loaded {
  ModelInfo info;
  ControllersModel controllers{nullptr};        // this alone, or
  std::shared_ptr<const FlowModelParts> parts;  // these two, or a flow:
  std::shared_ptr<const FlowNetwork> network;
  std::shared_ptr<const TransitionPlanner> planner;
  std::shared_ptr<TorchWeights> torch;  // either this
  int torch_rows = 0;
  std::shared_ptr<const PackedFlow> packed;  // or this

  std::unique_ptr<StepEngine> Engine(const Device& device, int slots) const {
    if (!controllers.is_empty())
      return std::make_unique<ControllersEngine>(info, slots, controllers);
    if (network)
      return std::make_unique<ContinuousFlowEngine>(info, device.name(), slots, parts, network);
    return std::make_unique<FlowEngine>(info, device.name(), slots, planner, Tile(slots));
  }

 private:
  std::unique_ptr<FlowTile> Tile(int slots) const {
    if (packed) return std::make_unique<PackedTile>(packed, slots);
    return std::make_unique<TorchTile>(torch, torch_rows, slots);
  }
};

// It has one engine, which is small: whatever steps the flow elsewhere, this runs on the CPU.
Loaded LoadControllers(const Safetensors& content, const std::filesystem::path& path) {
  const ControllersCheckpoint checkpoint = ParseControllers(content, path.string());
  const ControllersConfig& config = checkpoint.model->config();
  VelocityReference median{.name = "median"};
  std::ranges::copy(checkpoint.median_factors, median.factors.begin());
  Loaded loaded;
  loaded.controllers = checkpoint.model;
  loaded.info = {.name = config.name,
                 .fingerprint = Fingerprint(config.name, checkpoint.hash,
                                            TorchKernels(torch::Device(torch::kCPU))),
                 .licence = LicenceOf(checkpoint.card),
                 .card = checkpoint.card,
                 .skeleton = checkpoint.model->skeleton(),
                 .fps = 30,
                 .history_frames = config.history_frames,
                 .audio_features = 0,  // it hears no music
                 .max_transition_frames = config.max_transition_frames,
                 .default_temperature = 0,
                 .hears_music = false,
                 .deterministic = true,
                 .root_path = true,
                 .velocity_factors = config.velocity_factors,
                 .velocity_references = {median}};
  return loaded;
}

Loaded LoadContinuousFlow(const Safetensors& content, const std::filesystem::path& path) {
  const ContinuousFlowCheckpoint checkpoint = ParseContinuousFlow(content, path.string());
  const ContinuousFlowConfig& config = checkpoint.model->config();
  VelocityReference median{.name = "median"};
  std::ranges::copy(config.median_factors, median.factors.begin());
  Loaded loaded;
  loaded.parts = std::make_shared<FlowModelParts>(checkpoint.model->Parts());
  loaded.network = MakeTorchFlowNetwork(checkpoint.model);
  loaded.info = {.name = config.name,
                 .fingerprint = Fingerprint(config.name, checkpoint.hash,
                                            TorchKernels(torch::Device(torch::kCPU))),
                 .licence = LicenceOf(checkpoint.card),
                 .card = checkpoint.card,
                 .skeleton = checkpoint.model->skeleton(),
                 .fps = 30,
                 .history_frames = config.history_frames,
                 .audio_features = 40,
                 .max_transition_frames = config.max_transition_frames,
                 .default_temperature = config.temperature,
                 .hears_music = false,  // but its beats
                 .root_path = true,
                 .velocity_factors = true,
                 .velocity_references = {median}};
  return loaded;
}

Loaded Load(const std::filesystem::path& path, const Device& device, EngineKind kind,
            const std::string& kernel_name) {
  const c10::InferenceMode inference;
  // Exact float32 everywhere: bits before speed.
  at::globalContext().setAllowTF32CuBLAS(false);
  at::globalContext().setAllowTF32CuDNN(false);
  at::globalContext().setDeterministicCuDNN(true);

  const Safetensors content = ReadSafetensors(path);
  if (HoldsControllers(content)) return LoadControllers(content, path);
  if (HoldsContinuousFlow(content)) return LoadContinuousFlow(content, path);
  const Checkpoint checkpoint = ParseCheckpoint(content, path.string());
  FlowModel model = checkpoint.model;
  const FlowConfig& config = model->config();
  const torch::Device there = ToTorch(device);
  Loaded loaded;
  std::string kernels = TorchKernels(there);
  // A baseline without a flow has nothing to pack.
  const bool packs = kind == EngineKind::kPacked || kind == EngineKind::kPackedBf16 ||
                     (kind == EngineKind::kAuto && there.is_cpu());
  if (packs && config.flow_steps > 0) {
    if (!there.is_cpu()) {
      throw InvalidArgument("engine", "packed computes on the CPU, not on " + device.name());
    }
    const KernelSet set = ChooseKernels(kind, kernel_name);
    const PackedKernels& exact = *set.exact;
    const PackedKernels& products = *set.products;
    const std::string name = std::string("packed ") + products.name;
    loaded.packed =
        std::make_shared<PackedFlow>(content, config, model->feature_width(), exact, products);
    if (PackedPlanner::Serves(config)) {
      kernels = name;
      loaded.planner =
          std::make_shared<PackedPlanner>(content, config, model->skeleton(), exact, products);
    } else {
      model->ForgetFlow();
      kernels = name + ", plans by " + kernels;
    }
  } else {
    if (kind == EngineKind::kTorchBf16) {
      model->RoundNetworks();
      kernels += ", bf16";
    }
    model->to(there);
    loaded.torch = std::make_shared<TorchWeights>();
    loaded.torch->device = there;
    loaded.torch->inverse_weights = model->InverseWeights();
    loaded.torch->model = model;
    loaded.torch_rows = TorchTile::VerifiedRows(loaded.torch);
    if (loaded.torch_rows == 1) {
      std::clog << "choreo: on " << device.name()
                << " a row's bits depend on its batch, so rows are stepped one by one (slower)\n";
    }
    kernels += ", tile " + std::to_string(loaded.torch_rows);
  }
  if (!loaded.planner) loaded.planner = std::make_shared<TorchPlanner>(model, there);
  // Without a flow the plan is what is danced: frames have no noise of their own.
  const bool flow = config.flow_steps > 0;
  loaded.info = {.name = config.name,
                 .fingerprint = Fingerprint(config.name, checkpoint.hash, kernels),
                 .licence = LicenceOf(checkpoint.card),
                 .card = checkpoint.card,
                 .skeleton = model->skeleton(),
                 .fps = 30,
                 .history_frames = config.history_frames,
                 .audio_features = config.audio_features,
                 .max_transition_frames = config.max_transition_frames,
                 .default_temperature = config.temperature,
                 .hears_music = config.hears_music,
                 .fine_temperature = flow ? config.fine_temperature : 0,
                 .follow = config.follow,
                 .deterministic = !flow && config.planner.variety == 0,
                 .velocity_references = {}};
  return loaded;
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

std::vector<std::unique_ptr<StepEngine>> MakeEngines(const std::filesystem::path& path,
                                                     std::span<const Device> devices, int slots,
                                                     EngineKind kind, const std::string& kernels) {
  if (slots < 1 || slots > 4096) {
    throw InvalidArgument("slots", std::to_string(slots) + " is not in [1, 4096]");
  }
  std::map<Device, Loaded> loaded;
  std::vector<std::unique_ptr<StepEngine>> engines;
  for (const Device& device : devices) {
    const auto [here, is_new] = loaded.try_emplace(device);
    if (is_new) here->second = Load(path, device, kind, kernels);
    engines.push_back(here->second.Engine(device, slots));
  }
  return engines;
}

std::unique_ptr<StepEngine> MakeEngine(const std::filesystem::path& checkpoint,
                                       const Device& device, int slots, EngineKind kind) {
  return std::move(MakeEngines(checkpoint, {&device, 1}, slots, kind).front());
}

std::shared_ptr<const TransitionPlanner> MakeTransitionPlanner(
    const std::filesystem::path& checkpoint, const Device& device, EngineKind kind) {
  return Load(checkpoint, device, kind, "").planner;
}

}  // namespace choreo
