#include "model/controllers/checkpoint.h"

#include <torch/torch.h>

#include <utility>

#include "model/controllers/random_controllers.h"
#include "model/flow/checkpoint.h"
#include "model/flow/checkpoint_file.h"

namespace choreo {
namespace {

// Raised when the meaning of a stored tensor or field changes.
constexpr const char* kFormat = "choreo-controllers-1";

}  // namespace

bool HoldsControllers(const Safetensors& content) {
  const auto format = content.metadata.find("format");
  return format != content.metadata.end() && format->second.starts_with("choreo-controllers-");
}

ControllersCheckpoint ParseControllers(const Safetensors& content, const std::string& name) {
  const CheckpointFile file(content, name, kFormat);
  ControllersCheckpoint checkpoint{
      .model = ControllersModel(file.Get<ControllersConfig>("config"), file.skeleton()),
      .median_factors = file.Get<std::array<double, kBodyParts>>("median_factors"),
      .card = file.card(),
      .hash = file.hash()};
  ImportTensors(content, "", checkpoint.model.get());
  checkpoint.model->eval();
  return checkpoint;
}

std::string SaveControllers(const std::filesystem::path& path, ControllersModel& model,
                            const std::array<double, kBodyParts>& median_factors,
                            const nlohmann::json& card) {
  Safetensors content;
  ExportTensors(*model, "", &content);
  content.metadata["median_factors"] = nlohmann::json(median_factors).dump();
  return WriteCheckpointFile(path, std::move(content), kFormat, model->config(), model->skeleton(),
                             card);
}

void WriteRandomControllers(const std::filesystem::path& path, const ControllersConfig& config,
                            const Skeleton& skeleton, uint64_t seed) {
  torch::manual_seed(seed);
  ControllersModel model(config, skeleton);
  torch::NoGradGuard no_grad;
  for (auto& parameter : model->parameters()) {
    // What starts as zero would hide everything before it.
    if (!parameter.any().item<bool>()) parameter.copy_(0.05 * torch::randn_like(parameter));
  }
  const int64_t others = skeleton.joints() - 1;
  model->SetNormalisation(torch::zeros({others, 3}), torch::full({others, 3}, 0.1),
                          torch::full({kBodyParts}, 0.01));
  SaveControllers(path, model, {0.01, 0.02, 0.02, 0.015, 0.015},
                  {{"licence", "none: random weights"}});
}

}  // namespace choreo
