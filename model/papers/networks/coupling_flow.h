#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/container/modulelist.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/rnn.h>
#include <torch/nn/pimpl.h>
#include <torch/types.h>

#include "model/papers/networks/flow_config.h"
#include "model/papers/networks/lstm_layer.h"

/// The conditional normalizing flow of paper F, Section 3.2.2 and Figure 3: K times ActNorm →
/// invertible linear (PLU) → affine coupling. Works on standardised features [batch, time, width];
/// conditions are [batch, time, condition]. Not thread-safe.
namespace choreo {

/// Recurrent state of every coupling, flattened: [batch, StateWidth()].
using FlowState = torch::Tensor;

inline constexpr int kLstmLayers = 2;  ///< of a coupling's network
/// The state of one coupling, layer by layer.
using CouplingState = std::array<LstmState, kLstmLayers>;

/// The network [a, b] = f(h_lo, condition) of one coupling (Eq. 7): a 2-layer LSTM and a linear
/// layer that starts at zero.
class CouplingNetworkImpl : public torch::nn::Module {
 public:
  CouplingNetworkImpl(int input, int hidden, int output);
  /// Reads and replaces `state`.
  torch::Tensor forward(const torch::Tensor& input, CouplingState* state);
  int StateWidth() const { return 2 * kLstmLayers * hidden_; }

 private:
  torch::Tensor RunFused(const torch::Tensor& input, CouplingState* state);
  int hidden_;
  torch::nn::LSTM lstm_{nullptr};
  torch::nn::Linear last_{nullptr};
};
TORCH_MODULE(CouplingNetwork);

/// One step f_k.
class FlowStepImpl : public torch::nn::Module {
 public:
  FlowStepImpl(int width, int condition, int hidden);
  /// x → z; adds log |det dz/dx| of each frame to `log_det` [batch, time].
  torch::Tensor Forward(const torch::Tensor& x, const torch::Tensor& condition,
                        CouplingState* state, torch::Tensor* log_det);
  /// z → x; adds the same log-determinant, unless `log_det` is null.
  torch::Tensor Inverse(const torch::Tensor& z, const torch::Tensor& condition,
                        const torch::Tensor& inverse_weight, CouplingState* state,
                        torch::Tensor* log_det);
  /// (W^-1)^T of the invertible linear layer, [width, width]; computed in float64.
  torch::Tensor InverseWeight() const;
  /// Initialises ActNorm so that `x` leaves it with zero mean and unit variance. Returns x after
  /// the whole step.
  void InitialiseActNorm(const torch::Tensor& x);
  int StateWidth() const { return network_->StateWidth(); }

 private:
  torch::Tensor Weight() const;
  /// [mu, delta] of Eq. 7 for one half.
  std::pair<torch::Tensor, torch::Tensor> Affine(const torch::Tensor& low,
                                                 const torch::Tensor& condition,
                                                 CouplingState* state);
  int low_;                                   ///< width of the half that passes unchanged
  torch::Tensor norm_bias_, norm_log_scale_;  // [width]
  torch::Tensor permutation_, sign_, lower_, upper_, log_diagonal_;  // PLU
  CouplingNetwork network_{nullptr};
};
TORCH_MODULE(FlowStep);

class CouplingFlowImpl : public torch::nn::Module {
 public:
  CouplingFlowImpl(int width, int condition, const FlowConfig& config);

  /// x → z, adding to `log_det` [batch, time]; `state` starts as zeros and is replaced.
  torch::Tensor Forward(const torch::Tensor& x, const torch::Tensor& condition, FlowState* state,
                        torch::Tensor* log_det);
  /// z → x. `inverse_weights`: from InverseWeights(), computed once per roll-out, not once per
  /// frame.
  torch::Tensor Inverse(const torch::Tensor& z, const torch::Tensor& condition,
                        const std::vector<torch::Tensor>& inverse_weights, FlowState* state,
                        torch::Tensor* log_det);
  /// z → x with the states in separate tensors, which are replaced; `log_det` may be null.
  torch::Tensor Inverse(const torch::Tensor& z, const torch::Tensor& condition,
                        const std::vector<torch::Tensor>& inverse_weights,
                        std::vector<CouplingState>* states, torch::Tensor* log_det);
  std::vector<CouplingState> Split(const FlowState& state) const;
  std::vector<torch::Tensor> InverseWeights() const;
  void InitialiseActNorm(const torch::Tensor& x, const torch::Tensor& condition);
  /// Zeros, [batch, StateWidth()].
  FlowState InitialState(int64_t batch) const;
  int StateWidth() const;

 private:
  torch::nn::ModuleList steps_;
};
TORCH_MODULE(CouplingFlow);

}  // namespace choreo
