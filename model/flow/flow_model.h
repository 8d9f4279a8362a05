#pragma once

#include <torch/nn/module.h>
#include <torch/types.h>

#include "model/flow/coupling_flow.h"
#include "model/flow/flow_config.h"
#include "model/flow/planner.h"
#include "model/flow/variety.h"
#include "model/motion/skeleton.h"

/// Paper F's model: p(x_t | past tau frames, music, key pose, frames left), an autoregressive
/// normalizing flow. With a planner (preset `default`) the features x are relative to the plan;
/// without one (`paper`) they are absolute in the canonical frame.
namespace choreo {

/// What is known of a transition before its first frame.
struct TransitionContext {
  /// Reference poses of motion/pose_codec.h: the plan, or undefined tensors where features are
  /// absolute.
  TrajectoryTensors reference;
  /// [batch, N, static_width()]: key pose, frames left and the planner's hidden state, as far as
  /// they can be computed ahead.
  torch::Tensor static_condition;
};

class FlowModelImpl : public torch::nn::Module {
 public:
  FlowModelImpl(const FlowConfig& config, const Skeleton& skeleton);

  const FlowConfig& config() const { return config_; }
  const Skeleton& skeleton() const { return skeleton_; }
  int feature_width() const { return width_; }
  int static_width() const;
  int StateWidth() const { return flow_->StateWidth(); }

  /// Plans a batch of transitions and hoists their static condition. `variety` [batch,
  /// Variety::Waves(N), components] of unit spread, times each wave's temperature, varies the plan;
  /// undefined: its mean.
  TransitionContext Begin(const TransitionTensors& transition, const torch::Tensor& variety = {});
  /// The same around the plan that comes nearest to `truth`, as training has it.
  TransitionContext BeginNear(const TransitionTensors& transition, const TrajectoryTensors& truth);

  /// One frame for a batch of slots, which may belong to different transitions. Features in
  /// physical units.
  struct StepResult {
    torch::Tensor features;        ///< [batch, width]
    torch::Tensor log_likelihood;  ///< [batch] nats, standardised space
  };
  /// `past` [batch, tau, width] oldest first; `audio` [batch, tau + 1, audio_features] rows
  /// t-tau..t; `has_audio` [batch, 1]; `static_condition` [batch, static_width()]; `noise` [batch,
  /// width], temperature already applied; `state` is replaced.
  StepResult Step(const torch::Tensor& past, const torch::Tensor& audio,
                  const torch::Tensor& has_audio, const torch::Tensor& static_condition,
                  const torch::Tensor& noise, const std::vector<torch::Tensor>& inverse_weights,
                  FlowState* state);
  std::vector<torch::Tensor> InverseWeights() const { return flow_->InverseWeights(); }
  /// Rounds what Step multiplies by most, the coupling networks and the encoder, to bfloat16.
  void RoundNetworks();
  /// Frees the flow's weights, which are most of the memory: afterwards there is only Begin.
  void ForgetFlow();

  /// Exact log-likelihood of frames, [batch, N] nats in standardised space. `features` [batch, tau
  /// + N, width] physical, history first; `audio` [batch, tau + N, audio_features]; `has_audio`
  /// [batch, 1]. In training mode past frames are dropped and noised.
  torch::Tensor LogLikelihood(const torch::Tensor& features, const torch::Tensor& audio,
                              const torch::Tensor& has_audio, const TransitionContext& context);
  /// ActNorm's data-dependent start, on one batch given as to LogLikelihood.
  void InitialiseActNorm(const torch::Tensor& features, const torch::Tensor& audio,
                         const torch::Tensor& has_audio, const TransitionContext& context);

  /// Features of frames against a context's reference, [batch, tau + N, width]: `absolute` holds
  /// them in the canonical frame (as PoseCodec has them), `truth` the N frames' poses. History
  /// stands on its own reference: zero position and rotation.
  torch::Tensor RelativeFeatures(const torch::Tensor& absolute, const TrajectoryTensors& truth,
                                 const TransitionContext& context) const;
  /// Poses of the N frames from their features, [batch, N, width] → canonical trajectory.
  /// Differentiable.
  TrajectoryTensors Decode(const torch::Tensor& features, const TransitionContext& context) const;
  /// Samples N frames on the model's own history, without arrival: [batch, N, width]. `history`
  /// [batch, tau, width] as RelativeFeatures has it, `audio` [batch, tau + N, audio_features],
  /// `noise` [batch, N, width]. Differentiable.
  torch::Tensor Rollout(const torch::Tensor& history, const torch::Tensor& audio,
                        const torch::Tensor& has_audio, const TransitionContext& context,
                        const torch::Tensor& noise);

  /// Statistics by which the network's inputs are standardised: [width], [audio_features].
  void SetFeatureNormalisation(const torch::Tensor& mean, const torch::Tensor& std);
  void SetAudioNormalisation(const torch::Tensor& mean, const torch::Tensor& std);
  bool has_planner() const { return planner_ != nullptr; }
  Planner planner() const { return planner_; }
  Variety variety() const { return variety_; }  ///< null: plans do not vary
  CouplingFlow flow() const { return flow_; }

 private:
  PlannerImpl::Plan PlanOf(const TransitionTensors& transition);
  TransitionContext Hoist(const TransitionTensors& transition, const PlannerImpl::Plan& plan);
  torch::Tensor Standardise(const torch::Tensor& features) const;
  torch::Tensor StandardiseAudio(const torch::Tensor& audio, const torch::Tensor& has_audio) const;
  /// Condition of every frame from standardised, flattened parts.
  torch::Tensor Condition(const torch::Tensor& past, const torch::Tensor& audio,
                          const torch::Tensor& static_condition);
  /// Condition of the N frames behind a history, and their standardised features.
  std::pair<torch::Tensor, torch::Tensor> Windows(const torch::Tensor& features,
                                                  const torch::Tensor& audio,
                                                  const torch::Tensor& has_audio,
                                                  const TransitionContext& context);

  FlowConfig config_;
  Skeleton skeleton_;
  int width_;
  torch::Tensor feature_mean_, feature_std_, audio_mean_, audio_std_;
  Planner planner_;
  Variety variety_{nullptr};
  torch::Tensor pairs_;  // [joints] of MirrorPairs
  CouplingFlow flow_{nullptr};
  /// Shared encoding (condition_width > 0): one linear map a part, summed, then a second layer.
  torch::nn::Linear encode_past_{nullptr}, encode_static_{nullptr}, encode_audio_{nullptr},
      encode_{nullptr};
};
TORCH_MODULE(FlowModel);

}  // namespace choreo
