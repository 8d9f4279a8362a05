#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/rnn.h>
#include <torch/nn/pimpl.h>
#include <torch/types.h>

#include <filesystem>
#include <string>

#include "model/flow/checkpoint/checkpoint.h"
#include "model/motion/skeleton.h"
#include "model/papers/networks/flow_config.h"
#include "model/papers/networks/lstm_layer.h"
#include "model/papers/networks/transition_tensors.h"

namespace choreo {

/// The baseline of both papers, after Harvey et al. 2020, "Robust Motion In-Betweening": a
/// recurrent network predicts frame by frame from the last pose. Its inputs are the key, the
/// difference from it and, added to all encodings, the number of frames left (their Section 3.3).
/// In training, noise hides the key while it is far away (Section 3.4). It is deterministic and has
/// no music input. Unlike theirs, it has no adversarial losses, and it is a quarter as wide.
///
/// Features and key conditions are paper F's (PoseCodec, key_condition.h). It outputs poses and
/// contacts, and zeros for velocities, which nothing reads. Not thread-safe.
class InbetweenerImpl : public torch::nn::Module {
 public:
  InbetweenerImpl(const FlowConfig& config, const Skeleton& skeleton);

  const FlowConfig& config() const { return config_; }
  const Skeleton& skeleton() const { return skeleton_; }
  int feature_width() const { return width_; }

  /// Zeros.
  LstmState InitialState(int64_t batch) const;
  /// Computes the features [batch, width] of the frame after `past` [batch, n + 1, width], whose
  /// last n frames are new to `state`. `condition`: [batch, KeyConditionWidth]. `veil`: noise for
  /// the encodings of the key, [batch, 2 * width], or undefined.
  torch::Tensor Step(const torch::Tensor& past, const torch::Tensor& condition,
                     const torch::Tensor& veil, LstmState* state);
  /// Computes N frames autoregressively, [batch, N, width], from `history` [batch, tau, width] and
  /// `conditions` [batch, N, KeyConditionWidth]. Adds the veil in training mode. Differentiable.
  torch::Tensor Rollout(const torch::Tensor& history, const torch::Tensor& conditions);

  /// Sets mean and standard deviation of features, [width] each.
  void SetNormalisation(const torch::Tensor& mean, const torch::Tensor& std);

 private:
  torch::Tensor Remember(const torch::Tensor& inputs, LstmState* state);

  FlowConfig config_;
  Skeleton skeleton_;
  int width_, pose_;  ///< the numbers of a frame's features, and of pose features among them
  torch::Tensor mean_, std_;
  torch::nn::Sequential state_encoder_{nullptr}, offset_encoder_{nullptr}, target_encoder_{nullptr},
      decoder_{nullptr};
  torch::nn::LSTM lstm_{nullptr};
};
TORCH_MODULE(Inbetweener);

/// Checkpoints of the baseline (see model/flow/checkpoint/checkpoint.h).
using InbetweenerCheckpoint = CheckpointOf<Inbetweener>;
bool HoldsInbetweener(const Safetensors& content);
/// `name` is the file's name in errors. Throws what ParseCheckpoint throws.
InbetweenerCheckpoint ParseInbetweener(const Safetensors& content, const std::string& name);
/// Writes a checkpoint atomically. Returns the content hash.
std::string SaveInbetweener(const std::filesystem::path& path, Inbetweener& model,
                            const nlohmann::json& card);

}  // namespace choreo
