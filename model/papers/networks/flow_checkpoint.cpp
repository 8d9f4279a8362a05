#include "model/papers/networks/flow_checkpoint.h"

#include <utility>

namespace choreo {
namespace {

// Raised when the meaning of a stored tensor or field changes.
constexpr const char* kFlowFormat = "choreo-flow-1";

// Refuses a former kind of network by its name.
struct NoFormerFlow {};
void from_json(const nlohmann::json& config, NoFormerFlow& /*none*/) {
  if (config.contains("planner") && config["planner"].value("width", 0) > 0) {
    throw InvalidArgument("planner",
                          "networks around a planner are no longer danced; train --preset default");
  }
  if (!config.value("recurrent", true))
    throw InvalidArgument("recurrent", "false: flows without memory are no longer danced");
}

}  // namespace

std::string SaveCheckpoint(const std::filesystem::path& path, FlowModel& model, Safetensors weights,
                           const nlohmann::json& card) {
  return WriteCheckpointFile(path, std::move(weights), kFlowFormat, model->config(),
                             model->skeleton(), card);
}

std::string SaveCheckpoint(const std::filesystem::path& path, FlowModel& model,
                           const nlohmann::json& card) {
  Safetensors content;
  ExportTensors(*model, "", &content);
  return SaveCheckpoint(path, model, std::move(content), card);
}

Checkpoint ParseCheckpoint(const Safetensors& content, const std::string& name) {
  const CheckpointFile file(content, name, kFlowFormat);
  file.Get<NoFormerFlow>("config");
  return BuildCheckpoint<FlowModel, FlowConfig>(file, content);
}

}  // namespace choreo
