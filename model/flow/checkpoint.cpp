#include "model/flow/checkpoint.h"

#include <torch/torch.h>

#include <utility>

namespace choreo {
namespace {

// Raised when the meaning of a stored tensor or field changes.
constexpr const char* kFlowFormat = "choreo-flow-1";

// Refuses by name what is danced no more.
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

void ExportTensor(const std::string& name, const torch::Tensor& value, Safetensors* content) {
  const torch::Tensor dense = value.detach().to(torch::kCPU, torch::kFloat32).contiguous();
  const float* data = dense.data_ptr<float>();
  content->tensors[name] = {dense.sizes().vec(), {data, data + dense.numel()}};
}

void ImportTensor(const Safetensors& content, const std::string& name, torch::Tensor value) {
  torch::NoGradGuard no_grad;
  const NamedTensor& held = content.Get(name, value.sizes().vec());
  value.copy_(torch::from_blob(const_cast<float*>(held.data.data()), held.shape, torch::kFloat32));
}

void ExportTensors(const torch::nn::Module& module, const std::string& prefix,
                   Safetensors* content) {
  for (const auto& item : module.named_parameters())
    ExportTensor(prefix + item.key(), item.value(), content);
  for (const auto& item : module.named_buffers())
    ExportTensor(prefix + item.key(), item.value(), content);
}

void ImportTensors(const Safetensors& content, const std::string& prefix,
                   torch::nn::Module* module) {
  for (auto& item : module->named_parameters())
    ImportTensor(content, prefix + item.key(), item.value());
  for (auto& item : module->named_buffers())
    ImportTensor(content, prefix + item.key(), item.value());
}

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
  return TakeUp<FlowModel, FlowConfig>(file, content);
}

}  // namespace choreo
