#include "model/papers/networks/controllers_checkpoint.h"

#include <torch/types.h>

#include <utility>

namespace choreo {
namespace {

// Raised when the meaning of a stored tensor or field changes.
constexpr const char* kFormat = "choreo-controllers-2";

}  // namespace

bool HoldsControllers(const Safetensors& content) {
  const auto format = content.metadata.find("format");
  return format != content.metadata.end() && format->second.starts_with("choreo-controllers-");
}

ControllersCheckpoint ParseControllers(const Safetensors& content, const std::string& name) {
  const CheckpointFile file(content, name, kFormat);
  return {BuildCheckpoint<ControllersModel, ControllersConfig>(file, content),
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

}  // namespace choreo
