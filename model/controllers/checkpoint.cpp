#include "model/controllers/checkpoint.h"

#include <torch/torch.h>

#include <utility>

#include "model/controllers/random_controllers.h"

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
  return {TakeUp<ControllersModel, ControllersConfig>(file, content),
          file.Get<std::array<double, kBodyParts>>("median_factors")};
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
  FillZeros(model.get());
  const int64_t others = skeleton.joints() - 1;
  model->SetNormalisation(torch::zeros({others, 3}), torch::full({others, 3}, 0.1),
                          torch::full({kBodyParts}, 0.01));
  SaveControllers(path, model, {0.01, 0.02, 0.02, 0.015, 0.015},
                  {{"licence", "none: random weights"}});
}

}  // namespace choreo
