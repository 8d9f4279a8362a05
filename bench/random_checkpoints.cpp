#include "bench/random_checkpoints.h"

#include <torch/nn/module.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "model/flow/network/continuous_flow.h"
#include "model/papers/networks/controllers_checkpoint.h"
#include "model/papers/networks/flow_checkpoint.h"
#include "model/papers/networks/inbetweener.h"

namespace choreo {
namespace {

const nlohmann::json kCard = {{"licence", "none: random weights"}};

// Weights that start at zero would hide everything before them.
void FillZeros(torch::nn::Module* module) {
  torch::NoGradGuard no_grad;
  for (auto& parameter : module->parameters()) {
    if (!parameter.any().item<bool>()) parameter.copy_(0.05 * torch::randn_like(parameter));
  }
}

}  // namespace

void WriteRandomCheckpoint(const std::filesystem::path& path, const FlowConfig& config,
                           const Skeleton& skeleton, uint64_t seed) {
  torch::manual_seed(seed);
  FlowModel model(config, skeleton);
  FillZeros(model.get());
  model->SetFeatureNormalisation(0.05 * torch::randn({model->feature_width()}),
                                 0.02 + 0.1 * torch::rand({model->feature_width()}));
  model->SetAudioNormalisation(torch::randn({config.audio_features}),
                               1 + torch::rand({config.audio_features}));
  if (config.innovations) {
    const int64_t width = model->feature_width();
    model->FitPrediction(0.05 * torch::randn({400, config.history_frames + 1, width}).cumsum(1),
                         torch::full({width}, 0.01));
  }
  SaveCheckpoint(path, model, kCard);
}

void WriteRandomInbetweener(const std::filesystem::path& path, const FlowConfig& config,
                            const Skeleton& skeleton, uint64_t seed) {
  torch::manual_seed(seed);
  Inbetweener model(config, skeleton);
  FillZeros(model.get());
  const int64_t width = model->feature_width();
  model->SetNormalisation(torch::zeros({width}), torch::full({width}, 0.1));
  SaveInbetweener(path, model, kCard);
}

void WriteRandomContinuousFlow(const std::filesystem::path& path,
                               const ContinuousFlowConfig& config, const Skeleton& skeleton,
                               uint64_t seed) {
  torch::manual_seed(seed);
  ContinuousFlow model(config, skeleton);
  FillZeros(model.get());
  Safetensors weights;
  ExportTensors(*model, "", &weights);
  SaveContinuousFlow(path, model, std::move(weights), kCard);
}

void WriteRandomControllers(const std::filesystem::path& path, const ControllersConfig& config,
                            const Skeleton& skeleton, uint64_t seed) {
  torch::manual_seed(seed);
  ControllersModel model(config, skeleton);
  FillZeros(model.get());
  const int64_t others = skeleton.joints() - 1;
  model->SetNormalisation(torch::zeros({others, 3}), torch::full({others, 3}, 0.1),
                          torch::full({kBodyParts}, 0.01));
  SaveControllers(path, model, {0.01, 0.02, 0.02, 0.015, 0.015}, kCard);
}

}  // namespace choreo
