#include "model/flow/checkpoint/checkpoint.h"

#include <torch/utils.h>

namespace choreo {

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

}  // namespace choreo
