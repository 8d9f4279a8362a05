#include "model/papers/samplers/paper_samplers.h"

#include <memory>

#include "model/audio/signal/mfcc.h"
#include "model/flow/network/torch_kernels.h"
#include "model/papers/networks/controllers_checkpoint.h"
#include "model/papers/networks/flow_checkpoint.h"
#include "model/papers/networks/inbetweener.h"
#include "model/papers/samplers/autoregressive_flow.h"
#include "model/papers/samplers/controllers_sampler.h"
#include "model/papers/samplers/inbetweener_stepper.h"
#include "model/papers/samplers/packed_flow.h"
#include "model/papers/samplers/torch_stepper.h"

namespace choreo {
namespace {

void HearMfcc(std::span<const double> bands, std::span<float> features) {
  MfccOfMelDb(bands.first<kMelBands>(), features.first<kMfccCount>());
}

// Always on the CPU: the network is small.
SamplerFactory LoadControllers(const Safetensors& content, const std::string& name) {
  const ControllersCheckpoint checkpoint = ParseControllers(content, name);
  ModelInfo info = InfoOf(checkpoint, {.torch = TorchKernels(torch::kCPU)});
  info.takes_music = false;
  info.default_temperature = 0;
  info.deterministic = true;
  info.controls.emplace_back(kControls[kRootPath].name);
  if (checkpoint.model->config().velocity_factors)
    info.controls.emplace_back(kControls[kVelocityFactors].name);
  info.velocity_references = {MedianReference(checkpoint.median_factors)};
  return [info, model = checkpoint.model] {
    return std::make_unique<ControllersSampler>(info, model);
  };
}

// Always on the CPU, too.
SamplerFactory LoadInbetweener(const Safetensors& content, const std::string& name) {
  const InbetweenerCheckpoint checkpoint = ParseInbetweener(content, name);
  ModelInfo info = InfoOf(checkpoint, {.torch = TorchKernels(torch::kCPU)});
  info.default_temperature = 0;
  info.deterministic = true;
  return [info, model = checkpoint.model] {
    return std::make_unique<AutoregressiveFlowSampler>(info, model->config(), "cpu", [model] {
      return std::make_unique<InbetweenerStepper>(model);
    });
  };
}

SamplerFactory LoadFlow(const Safetensors& content, const std::string& name,
                        const EngineRequest& request) {
  const Checkpoint checkpoint = ParseCheckpoint(content, name);
  FlowModel model = checkpoint.model;
  const FlowConfig& config = model->config();
  AutoregressiveFlowSampler::MakeStepper stepper;
  UsedKernels kernels;
  if (const auto set = ChooseKernels(request)) {
    kernels.packed = set->products->name;
    const auto packed = std::make_shared<const PackedFlow>(content, config, model->skeleton(),
                                                           *set->exact, *set->products);
    stepper = [packed] { return std::make_unique<PackedStepper>(packed); };
  } else {
    const torch::Device there(request.device.name());
    model->to(there);
    const auto weights =
        std::make_shared<TorchWeights>(TorchWeights{model, model->InverseWeights(), there});
    kernels.torch = TorchKernels(weights->device);
    stepper = [weights] { return std::make_unique<TorchStepper>(weights); };
  }
  ModelInfo info = InfoOf(checkpoint, kernels);
  info.takes_music = config.audio_features == kMfccCount;
  if (config.hears_music) info.music_features = {config.audio_features, &HearMfcc};
  info.default_temperature = config.temperature;
  info.likelihood = true;
  return [info, config, device = request.device.name(), stepper] {
    return std::make_unique<AutoregressiveFlowSampler>(info, config, device, stepper);
  };
}

}  // namespace

SamplerFactory LoadPaperModel(const Safetensors& content, const std::string& name,
                              const EngineRequest& request) {
  if (HoldsControllers(content)) return LoadControllers(content, name);
  if (HoldsInbetweener(content)) return LoadInbetweener(content, name);
  return LoadFlow(content, name, request);
}

}  // namespace choreo
