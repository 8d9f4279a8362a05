#pragma once

#include <torch/nn/module.h>
#include <torch/types.h>

#include "model/motion/skeleton.h"
#include "model/papers/networks/coupling_flow.h"
#include "model/papers/networks/flow_config.h"
#include "model/papers/networks/transition_tensors.h"

/// Paper F's model: an autoregressive normalizing flow p(x_t | past tau frames, music, key pose,
/// frames left). Features x are absolute, in the canonical frame. Not thread-safe.
namespace choreo {

class FlowModelImpl : public torch::nn::Module {
 public:
  FlowModelImpl(const FlowConfig& config, const Skeleton& skeleton);

  const FlowConfig& config() const { return config_; }
  const Skeleton& skeleton() const { return skeleton_; }
  int feature_width() const { return width_; }
  /// Width of a frame's key condition (key_condition.h), and after its first layer.
  int key_width() const;
  int static_width() const;
  int StateWidth() const { return flow_->StateWidth(); }

  /// The part of each frame's condition that is known before the first frame, the encoded key
  /// conditions: [batch, N, static_width()].
  torch::Tensor StaticCondition(const TransitionTensors& transition);
  /// Key conditions [..., key_width()] after the shared encoding's first layer, or unchanged
  /// without one.
  torch::Tensor Encode(const torch::Tensor& conditions);

  /// One frame of each transition of a batch. Features in physical units.
  struct StepResult {
    torch::Tensor features;        ///< [batch, width]
    torch::Tensor log_likelihood;  ///< [batch] of these features, nats in standardised space
  };
  /// `past` [batch, tau, width] oldest first; `audio` [batch, tau + 1, audio_features] rows
  /// t-tau..t; `has_audio` [batch, 1]; `static_condition` [batch, static_width()]; `noise` [batch,
  /// width], temperature already applied; `state` is replaced.
  StepResult Step(const torch::Tensor& past, const torch::Tensor& audio,
                  const torch::Tensor& has_audio, const torch::Tensor& static_condition,
                  const torch::Tensor& noise, const std::vector<torch::Tensor>& inverse_weights,
                  FlowState* state);
  std::vector<torch::Tensor> InverseWeights() const { return flow_->InverseWeights(); }
  /// The exact log-likelihood of frames, [batch, N], nats in standardised space. `features` [batch,
  /// tau + N, width] physical, history first; `audio` [batch, tau + N, audio_features]; `has_audio`
  /// [batch, 1]. In training mode, drops past frames and adds noise to them.
  torch::Tensor LogLikelihood(const torch::Tensor& features, const torch::Tensor& audio,
                              const torch::Tensor& has_audio,
                              const torch::Tensor& static_condition);
  /// Initialises ActNorm on one batch. Arguments as for LogLikelihood.
  void InitialiseActNorm(const torch::Tensor& features, const torch::Tensor& audio,
                         const torch::Tensor& has_audio, const torch::Tensor& static_condition);

  /// Samples N frames autoregressively, without arrival: [batch, N, width]. `history` [batch, tau,
  /// width], `audio` [batch, tau + N, audio_features], `noise` [batch, N, width]. Differentiable.
  torch::Tensor Rollout(const torch::Tensor& history, const torch::Tensor& audio,
                        const torch::Tensor& has_audio, const torch::Tensor& static_condition,
                        const torch::Tensor& noise);

  /// Statistics that standardise features, [width].
  void SetFeatureNormalisation(const torch::Tensor& mean, const torch::Tensor& std);
  /// For innovations: fits the linear prediction of a window's last frame from the frames before
  /// it, by least squares over `windows` [n, tau + 1, width] in physical units. Call it after
  /// SetFeatureNormalisation. The residual's spread is at least `floor` [width].
  void FitPrediction(const torch::Tensor& windows, const torch::Tensor& floor);
  /// The spread of the flow's output for each feature, [width], in physical units.
  torch::Tensor DrawnSpread() const;
  /// Statistics that standardise music, [audio_features].
  void SetAudioNormalisation(const torch::Tensor& mean, const torch::Tensor& std);
  CouplingFlow flow() const { return flow_; }

 private:
  torch::Tensor Standardise(const torch::Tensor& features) const;
  /// Converts standardised frames [..., width] to the flow's output, given the past of each [...,
  /// tau, width]; and the inverse.
  torch::Tensor Drawn(const torch::Tensor& frames, const torch::Tensor& past) const;
  torch::Tensor FrameOf(const torch::Tensor& drawn, const torch::Tensor& past) const;
  /// log |d frame / d drawn|, a scalar.
  torch::Tensor DrawnLogDet() const { return drawn_spread_.log().sum(); }
  torch::Tensor StandardiseAudio(const torch::Tensor& audio, const torch::Tensor& has_audio) const;
  /// The condition of every frame from standardised parts. `seen` is `past` [..., tau, width] after
  /// dropout and clamping.
  torch::Tensor Condition(const torch::Tensor& past, const torch::Tensor& seen,
                          const torch::Tensor& audio, const torch::Tensor& static_condition);
  /// With innovations: the value of each pose feature that would reach the key, [..., pose].
  torch::Tensor Aim(const torch::Tensor& past, const torch::Tensor& static_condition) const;
  int pose_width() const { return 3 + 3 * skeleton_.joints(); }
  /// The condition [batch, 1, condition] of the frame after `past`, for Step.
  torch::Tensor LiveCondition(const torch::Tensor& past, const torch::Tensor& audio,
                              const torch::Tensor& has_audio,
                              const torch::Tensor& static_condition);
  /// The flow's output for the N frames after a history, and their condition.
  std::pair<torch::Tensor, torch::Tensor> Windows(const torch::Tensor& features,
                                                  const torch::Tensor& audio,
                                                  const torch::Tensor& has_audio,
                                                  const torch::Tensor& static_condition);

  FlowConfig config_;
  Skeleton skeleton_;
  int width_;
  torch::Tensor feature_mean_, feature_std_, audio_mean_, audio_std_;
  /// In standardised units: the output is (x_t - sum of predict * past) / drawn_spread.
  torch::Tensor predict_, drawn_spread_;
  CouplingFlow flow_{nullptr};
  /// The shared encoding (condition_width > 0): one linear map per part, summed, then a second
  /// layer.
  torch::nn::Linear encode_past_{nullptr}, encode_static_{nullptr}, encode_audio_{nullptr},
      encode_{nullptr};
};
TORCH_MODULE(FlowModel);

}  // namespace choreo
