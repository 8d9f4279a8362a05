#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/rnn.h>
#include <torch/nn/pimpl.h>
#include <torch/types.h>

#include <filesystem>
#include <string>

#include "model/flow/checkpoint.h"
#include "model/motion/skeleton.h"
#include "model/papers/networks/flow_config.h"
#include "model/papers/networks/lstm_layer.h"
#include "model/papers/networks/transition_tensors.h"

namespace choreo {

/// The baseline of both papers, after Harvey et al. 2020, "Robust Motion In-Betweening": a
/// recurrent network goes frame by frame from the last pose, told at each where the key is, what is
/// missing to it and, added to all encodings, how many frames are left (their Section 3.3). Noise
/// hides the key in training as long as it is far away (Section 3.4). Deterministic; it hears
/// nothing. Their adversarial losses are left out, and it is a quarter as wide.
///
/// Features and key conditions are those of paper F (PoseCodec, key_condition.h), of which it draws
/// poses and contacts; velocities are zeros, which nothing reads.
class InbetweenerImpl : public torch::nn::Module {
 public:
  InbetweenerImpl(const FlowConfig& config, const Skeleton& skeleton);

  const FlowConfig& config() const { return config_; }
  const Skeleton& skeleton() const { return skeleton_; }
  int feature_width() const { return width_; }

  /// Zeros.
  LstmState InitialState(int64_t batch) const;
  /// The features [batch, width] of the frame behind `past` [batch, n + 1, width], whose last n
  /// frames are new to `state`. `condition`: [batch, KeyConditionWidth]. `veil`: what is added to
  /// all that it knows of the key, [batch, 2 * width], or undefined.
  torch::Tensor Step(const torch::Tensor& past, const torch::Tensor& condition,
                     const torch::Tensor& veil, LstmState* state);
  /// N frames on its own history: [batch, N, width] of `history` [batch, tau, width] and
  /// conditions [batch, N, KeyConditionWidth]. In training mode behind the veil. Differentiable.
  torch::Tensor Rollout(const torch::Tensor& history, const torch::Tensor& conditions);

  /// By which features are standardised, [width] each.
  void SetNormalisation(const torch::Tensor& mean, const torch::Tensor& std);

 private:
  torch::Tensor Remember(const torch::Tensor& inputs, LstmState* state);

  FlowConfig config_;
  Skeleton skeleton_;
  int width_, pose_;  ///< numbers of a frame's features, and of those its pose's
  torch::Tensor mean_, std_;
  torch::nn::Sequential state_encoder_{nullptr}, offset_encoder_{nullptr}, target_encoder_{nullptr},
      decoder_{nullptr};
  torch::nn::LSTM lstm_{nullptr};
};
TORCH_MODULE(Inbetweener);

/// Checkpoints of it, as those of the other networks.
using InbetweenerCheckpoint = CheckpointOf<Inbetweener>;
bool HoldsInbetweener(const Safetensors& content);
/// `name` is what errors call it. Throws as ParseCheckpoint does.
InbetweenerCheckpoint ParseInbetweener(const Safetensors& content, const std::string& name);
/// Writes atomically; returns the content hash.
std::string SaveInbetweener(const std::filesystem::path& path, Inbetweener& model,
                            const nlohmann::json& card);

}  // namespace choreo
