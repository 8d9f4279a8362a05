#pragma once

#include <torch/nn/module.h>
#include <torch/types.h>

#include "model/flow/planner.h"

namespace choreo {

/// What plans leave open, as smooth Gaussian noise around them: the coarse half of the density
/// whose fine half is the flow (a hierarchy as in Glow, Kingma and Dhariwal 2018: the coarse part
/// is split off and modelled by itself). The difference of a dance and its plan - root position and
/// log(R_plan^T R) - is written as principal pose components times sines in time up to 3 Hz; each
/// coefficient is normal, its standard deviation a function of component and frequency, times the
/// dancer's activity. Learnt from what a trained planner leaves over (training/fit_variety.h).
///
/// In a transition with a key the sines end at zero there, without one freely.
class VarietyImpl : public torch::nn::Module {
 public:
  /// `components`: principal components of poses.
  VarietyImpl(int joints, int components);

  /// Sines for N frames: all whose period is at least 10 frames.
  static int64_t Waves(int64_t frames) { return frames / 5; }
  int64_t components() const { return spread_.size(2); }

  /// `plan` varied by `coefficients` [batch, Waves(N), components] of unit spread; times a
  /// temperature they give a sample.
  TrajectoryTensors Vary(const TransitionTensors& transition, const TrajectoryTensors& plan,
                         const torch::Tensor& coefficients) const;
  /// The plan varied towards `truth` as far as components and waves reach: what the flow is trained
  /// around.
  TrajectoryTensors Approach(const TransitionTensors& transition, const TrajectoryTensors& plan,
                             const TrajectoryTensors& truth) const;

  /// Learns from differences of dances and plans of one length each (see Difference); from those
  /// that are too short for a wave, directions alone. What no sample shows does not vary.
  struct Sample {
    TransitionTensors transition;
    torch::Tensor difference;  ///< [batch, N, 3 + 3 joints]
  };
  void Fit(const std::vector<Sample>& samples);
  /// [batch, N, 3 + 3 joints]: metres, radians.
  static torch::Tensor Difference(const TrajectoryTensors& plan, const TrajectoryTensors& truth);

 private:
  torch::Tensor Analyse(const torch::Tensor& difference, const torch::Tensor& keyed) const;
  torch::Tensor Synthesise(const torch::Tensor& coefficients, const torch::Tensor& keyed,
                           int64_t frames) const;
  /// Logarithm of what all coefficients of a transition have in common, [batch].
  torch::Tensor Factor(const TransitionTensors& transition, const torch::Tensor& keyed) const;
  /// Standard deviations, [batch, waves, components].
  torch::Tensor Spread(const TransitionTensors& transition, const torch::Tensor& keyed,
                       int64_t waves) const;

  torch::Tensor basis_;     ///< [components, 3 + 3 joints] physical units
  torch::Tensor analysis_;  ///< [3 + 3 joints, components]
  torch::Tensor spread_;    ///< [free, keyed; frequency bins; components] logarithms
  torch::Tensor activity_;  ///< [free, keyed; 3] weights of the common factor's logarithm
};
TORCH_MODULE(Variety);

}  // namespace choreo
