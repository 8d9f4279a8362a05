#include "model/engine/torch_engine.h"

#include <ATen/Parallel.h>
#include <ATen/Version.h>
#include <torch/cuda.h>
#include <torch/torch.h>

#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "model/core/error.h"
#include "model/core/threads.h"
#include "model/engine/build_identity.h"
#include "model/engine/torch_step_engine.h"
#include "model/engine/torch_tile.h"
#include "model/flow/checkpoint.h"

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

// Everything that can change a bit: weights, build, libraries, kernels, threads, tile.
std::string Fingerprint(const Checkpoint& checkpoint, const torch::Device& device, int tile_rows) {
  std::string kernels = "torch " TORCH_VERSION ", ";
  if (device.is_cuda()) {
    kernels += "cuda";
  } else {
    kernels += DetectBlas().name + ", " + CpuCapability() + ", " +
               std::to_string(at::get_num_threads()) + " threads";
  }
  return checkpoint.model->config().preset + "/" + checkpoint.hash +
         "/choreo " CHOREO_VERSION ", " + BuildIdentity() + "/" + kernels + ", tile " +
         std::to_string(tile_rows);
}

std::string LicenceOf(const std::string& card) {
  const auto json = nlohmann::json::parse(card, nullptr, /*allow_exceptions=*/false);
  return json.is_object() ? json.value("licence", "") : "";
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

std::vector<std::unique_ptr<StepEngine>> MakeTorchEngines(const std::filesystem::path& path,
                                                          std::span<const Device> devices,
                                                          int slots) {
  if (slots < 1 || slots > 4096) {
    throw InvalidArgument("slots", std::to_string(slots) + " is not in [1, 4096]");
  }
  const c10::InferenceMode inference;
  // Exact float32 everywhere: bits before speed.
  at::globalContext().setAllowTF32CuBLAS(false);
  at::globalContext().setAllowTF32CuDNN(false);
  at::globalContext().setDeterministicCuDNN(true);

  struct Loaded {
    std::shared_ptr<TorchWeights> weights;
    ModelInfo info;
    int tile_rows = 0;
  };
  std::map<Device, Loaded> loaded;
  std::vector<std::unique_ptr<StepEngine>> engines;
  for (const Device& device : devices) {
    Loaded& here = loaded[device];
    if (!here.weights) {
      Checkpoint checkpoint = LoadCheckpoint(path);
      const FlowConfig& config = checkpoint.model->config();
      here.weights = std::make_shared<TorchWeights>();
      here.weights->device = ToTorch(device);
      checkpoint.model->to(here.weights->device);
      here.weights->inverse_weights = checkpoint.model->InverseWeights();
      here.weights->model = checkpoint.model;
      here.tile_rows = TorchTile::VerifiedRows(here.weights);
      if (here.tile_rows == 1) {
        std::clog << "choreo: on " << device.name()
                  << " a row's bits depend on its batch, so rows are stepped one by one (slower)\n";
      }
      here.info = {.name = config.preset,
                   .fingerprint = Fingerprint(checkpoint, here.weights->device, here.tile_rows),
                   .licence = LicenceOf(checkpoint.card),
                   .card = checkpoint.card,
                   .skeleton = checkpoint.model->skeleton(),
                   .fps = 30,
                   .history_frames = config.history_frames,
                   .audio_features = config.audio_features,
                   .max_transition_frames = config.max_transition_frames,
                   .default_temperature = config.temperature};
    }
    engines.push_back(std::make_unique<TorchStepEngine>(here.weights, here.info, device.name(),
                                                        slots, here.tile_rows));
  }
  return engines;
}

std::unique_ptr<StepEngine> MakeTorchEngine(const std::filesystem::path& checkpoint,
                                            const Device& device, int slots) {
  return std::move(MakeTorchEngines(checkpoint, {&device, 1}, slots).front());
}

}  // namespace choreo
