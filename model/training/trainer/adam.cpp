#include "model/training/trainer/adam.h"

#include <torch/utils.h>

#include <cmath>

#include "model/flow/checkpoint/checkpoint.h"

namespace choreo {

namespace {

constexpr double kBeta1 = 0.9, kBeta2 = 0.999, kEpsilon = 1e-8;  // paper F, Section 4.2

}  // namespace

double NormOf(const std::vector<torch::Tensor>& gradients) {
  double sum = 0;
  for (const auto& gradient : gradients) {
    if (gradient.defined()) sum += gradient.square().sum().item<double>();
  }
  return std::sqrt(sum);
}

Adam::Adam(const torch::nn::Module& module) {
  for (const auto& item : module.named_parameters()) {
    entries_.push_back({item.key(), item.value(), torch::zeros_like(item.value()),
                        torch::zeros_like(item.value())});
  }
}

void Adam::Step(double learning_rate, double max_norm) {
  torch::NoGradGuard no_grad;
  std::vector<torch::Tensor> gradients;
  for (const Entry& entry : entries_) gradients.push_back(entry.parameter.grad());
  const double norm = NormOf(gradients);
  if (!std::isfinite(norm)) return;
  const double clip = max_norm > 0 && norm > max_norm ? max_norm / norm : 1.0;
  ++steps_;
  const double correct1 = 1 - std::pow(kBeta1, steps_), correct2 = 1 - std::pow(kBeta2, steps_);
  for (Entry& entry : entries_) {
    if (!entry.parameter.grad().defined()) continue;
    const torch::Tensor gradient = entry.parameter.grad() * clip;
    entry.first.mul_(kBeta1).add_(gradient, 1 - kBeta1);
    entry.second.mul_(kBeta2).addcmul_(gradient, gradient, 1 - kBeta2);
    entry.parameter.addcdiv_(entry.first, (entry.second / correct2).sqrt_().add_(kEpsilon),
                             -learning_rate / correct1);
  }
}

void Adam::ZeroGrad() {
  for (Entry& entry : entries_) entry.parameter.mutable_grad().reset();
}

void Adam::Export(Safetensors* content) const {
  for (const Entry& entry : entries_) {
    ExportTensor("adam.first." + entry.name, entry.first, content);
    ExportTensor("adam.second." + entry.name, entry.second, content);
  }
  content->metadata["adam.steps"] = std::to_string(steps_);
}

void Adam::Import(const Safetensors& content) {
  for (Entry& entry : entries_) {
    ImportTensor(content, "adam.first." + entry.name, entry.first);
    ImportTensor(content, "adam.second." + entry.name, entry.second);
  }
  steps_ = std::stoll(content.metadata.at("adam.steps"));
}

}  // namespace choreo
