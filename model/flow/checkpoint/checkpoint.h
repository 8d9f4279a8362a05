#pragma once

#include <torch/nn/module.h>
#include <torch/types.h>

#include <string>

#include "model/core/files/safetensors.h"
#include "model/flow/checkpoint/checkpoint_file.h"

/// Checkpoints: safetensors files with everything needed to dance (weights, configuration,
/// skeleton, normalisation) and the model card (data, terms, training command, figures), protected
/// by a content hash. This header has the part shared by all networks.
namespace choreo {

template <typename Model>
struct CheckpointOf {
  Model model{nullptr};  ///< in eval mode, on the CPU
  std::string card;      ///< JSON text
  std::string hash;      ///< 128-bit content hash, hex
};

/// Saves one tensor by name, or loads it into a tensor of its shape.
void ExportTensor(const std::string& name, const torch::Tensor& value, Safetensors* content);
void ImportTensor(const Safetensors& content, const std::string& name, torch::Tensor value);
/// Saves parameters and buffers by name, or loads them. `prefix` separates several modules in one
/// file.
void ExportTensors(const torch::nn::Module& module, const std::string& prefix,
                   Safetensors* content);
void ImportTensors(const Safetensors& content, const std::string& prefix,
                   torch::nn::Module* module);

/// Makes the model of the checkpoint `file`, whose tensors are in `content`. Throws
/// Error(kInvalidArgument) naming a tensor that does not fit the configuration.
template <typename Model, typename Config>
CheckpointOf<Model> BuildCheckpoint(const CheckpointFile& file, const Safetensors& content) {
  CheckpointOf<Model> checkpoint{.model = Model(file.Get<Config>("config"), file.skeleton()),
                                 .card = file.card(),
                                 .hash = file.hash()};
  ImportTensors(content, "", checkpoint.model.get());
  checkpoint.model->eval();
  return checkpoint;
}

}  // namespace choreo
