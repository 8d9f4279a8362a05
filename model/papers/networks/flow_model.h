#pragma once

#include <torch/nn/module.h>
#include <torch/types.h>

#include "model/motion/skeleton.h"
#include "model/papers/networks/coupling_flow.h"
#include "model/papers/networks/flow_config.h"
#include "model/papers/networks/transition_tensors.h"

/// Paper F's model: p(x_t | past tau frames, music, key pose, frames left), an autoregressive
/// normalizing flow. Features x are absolute in the canonical frame.
namespace choreo {

class FlowModelImpl : public torch::nn::Module {
 public:
  FlowModelImpl(const FlowConfig& config, const Skeleton& skeleton);

  const FlowConfig& config() const { return config_; }
  const Skeleton& skeleton() const { return skeleton_; }
  int feature_width() const { return width_; }
  /// Width of a frame's key condition (key_condition.h), and behind its first layer.
  int key_width() const;
  int static_width() const;
  int StateWidth() const { return flow_->StateWidth(); }

  /// What is known of each frame before the first, [batch, N, static_width()]: Encode of the key
  /// conditions.
  torch::Tensor Begin(const TransitionTensors& transition);
  /// Key conditions [..., key_width()] behind the shared encoding's first layer, where there is
  /// one; else as they are.
  torch::Tensor Encode(const torch::Tensor& conditions);

  /// One frame for a batch of slots, which may belong to different transitions. Features in
  /// physical units.
  struct StepResult {
    torch::Tensor features;        ///< [batch, width]
    torch::Tensor log_likelihood;  ///< [batch] nats of these features, standardised space
  };
  /// `past` [batch, tau, width] oldest first; `audio` [batch, tau + 1, audio_features] rows
  /// t-tau..t; `has_audio` [batch, 1]; `static_condition` [batch, static_width()]; `noise` [batch,
  /// width], temperature already applied; `state` is replaced.
  StepResult Step(const torch::Tensor& past, const torch::Tensor& audio,
                  const torch::Tensor& has_audio, const torch::Tensor& static_condition,
                  const torch::Tensor& noise, const std::vector<torch::Tensor>& inverse_weights,
                  FlowState* state);
  std::vector<torch::Tensor> InverseWeights() const { return flow_->InverseWeights(); }
  /// Exact log-likelihood of frames, [batch, N] nats in standardised space. `features` [batch, tau
  /// + N, width] physical, history first; `audio` [batch, tau + N, audio_features]; `has_audio`
  /// [batch, 1]. In training mode past frames are dropped and noised.
  torch::Tensor LogLikelihood(const torch::Tensor& features, const torch::Tensor& audio,
                              const torch::Tensor& has_audio,
                              const torch::Tensor& static_condition);
  /// ActNorm's data-dependent start, on one batch given as to LogLikelihood.
  void InitialiseActNorm(const torch::Tensor& features, const torch::Tensor& audio,
                         const torch::Tensor& has_audio, const torch::Tensor& static_condition);

  /// Samples N frames on the model's own history, without arrival: [batch, N, width]. `history`
  /// [batch, tau, width], `audio` [batch, tau + N, audio_features],
  /// `noise` [batch, N, width]. Differentiable.
  torch::Tensor Rollout(const torch::Tensor& history, const torch::Tensor& audio,
                        const torch::Tensor& has_audio, const torch::Tensor& static_condition,
                        const torch::Tensor& noise);

  /// Statistics by which the network's inputs are standardised: [width], [audio_features].
  void SetFeatureNormalisation(const torch::Tensor& mean, const torch::Tensor& std);
  /// Of a model of innovations, once features are normalised: fits the linear prediction of each
  /// window's last frame from those before it, least squares over `windows` [n, tau + 1, width] in
  /// physical units. What is left of it spreads by `floor` [width] at least.
  void FitPrediction(const torch::Tensor& windows, const torch::Tensor& floor);
  /// Spread of what the flow draws of each feature, [width], physical units.
  torch::Tensor DrawnSpread() const;
  void SetAudioNormalisation(const torch::Tensor& mean, const torch::Tensor& std);
  CouplingFlow flow() const { return flow_; }

 private:
  torch::Tensor Standardise(const torch::Tensor& features) const;
  /// What the flow draws of standardised frames [..., width], given the past of each [..., tau,
  /// width], and back.
  torch::Tensor Drawn(const torch::Tensor& frames, const torch::Tensor& past) const;
  torch::Tensor FrameOf(const torch::Tensor& drawn, const torch::Tensor& past) const;
  /// log |d frame / d drawn|, a scalar.
  torch::Tensor DrawnLogDet() const { return drawn_spread_.log().sum(); }
  torch::Tensor StandardiseAudio(const torch::Tensor& audio, const torch::Tensor& has_audio) const;
  /// Condition of every frame from standardised parts: `seen` is what the network sees of `past`
  /// [..., tau, width].
  torch::Tensor Condition(const torch::Tensor& past, const torch::Tensor& seen,
                          const torch::Tensor& audio, const torch::Tensor& static_condition);
  /// Of a model of innovations: what of each feature of a pose would reach the key, [..., pose].
  torch::Tensor Aim(const torch::Tensor& past, const torch::Tensor& static_condition) const;
  int pose_width() const { return 3 + 3 * skeleton_.joints(); }
  /// Condition [batch, 1, condition] of the frame behind `past`, as Step takes it.
  torch::Tensor LiveCondition(const torch::Tensor& past, const torch::Tensor& audio,
                              const torch::Tensor& has_audio,
                              const torch::Tensor& static_condition);
  /// What the flow draws of the N frames behind a history, and their condition.
  std::pair<torch::Tensor, torch::Tensor> Windows(const torch::Tensor& features,
                                                  const torch::Tensor& audio,
                                                  const torch::Tensor& has_audio,
                                                  const torch::Tensor& static_condition);

  FlowConfig config_;
  Skeleton skeleton_;
  int width_;
  torch::Tensor feature_mean_, feature_std_, audio_mean_, audio_std_;
  /// Standardised: what is drawn is (x_t - sum of predict * past) / drawn_spread.
  torch::Tensor predict_, drawn_spread_;
  CouplingFlow flow_{nullptr};
  /// Shared encoding (condition_width > 0): one linear map a part, summed, then a second layer.
  torch::nn::Linear encode_past_{nullptr}, encode_static_{nullptr}, encode_audio_{nullptr},
      encode_{nullptr};
};
TORCH_MODULE(FlowModel);

}  // namespace choreo
