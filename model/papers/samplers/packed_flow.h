#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "model/core/files/safetensors.h"
#include "model/engine/packed/kernels.h"
#include "model/engine/packed/matrix.h"
#include "model/motion/skeleton.h"
#include "model/papers/networks/flow_config.h"
#include "model/papers/samplers/flow_stepper.h"

namespace choreo {

/// The flow's weights in PackedStepper's layout, read from a checkpoint's tensors by name.
/// Read-only; shared by the engines of a process.
///
/// The input of every coupling's network is [condition of the frame | z_lo | own hidden state], a
/// row of `input_width` floats. The part of a raw condition that is known when the transition
/// begins is not in this row: `hoisted` maps it to the initial value of the first product.
struct PackedFlow {
  /// The inverse of one step of the flow.
  struct Coupling {
    PackedLinear first;    ///< [input_width] -> gates of the first LSTM layer
    PackedLinear hoisted;  ///< [static_width] -> the same, including bias; none if encoded
    PackedLinear second;   ///< [hidden | own hidden state] -> gates of the second
    PackedLinear last;     ///< [hidden] -> [a, b]
    PackedLinear unmix;    ///< inverse of ActNorm and invertible linear map, folded in double
  };

  /// `products` computes the networks' products: `kernels`, or less exact kernels with the same
  /// panel. Products between noise and features use `kernels`. Throws Error(kInvalidArgument),
  /// naming a tensor that is missing or does not fit the configuration.
  PackedFlow(const Safetensors& content, const FlowConfig& config, const Skeleton& skeleton,
             const PackedKernels& kernels, const PackedKernels& products);

  /// With innovations, appends the standardised key, its mask and the frames left to each frame's
  /// encoding, [static_width(), frames].
  Eigen::MatrixXf WithAims(const Eigen::MatrixXf& encodings,
                           const Eigen::MatrixXf& conditions) const;
  float Standard(const float* features, int i) const {
    return (features[i] - feature_mean[i]) * feature_scale[i];
  }
  int low() const { return width / 2; }
  int high() const { return width - low(); }
  /// Floats of a transition's recurrent state: h and c of both layers of each step.
  int state_width() const { return config.flow_steps * 4 * config.hidden; }
  /// Floats per frame of the couplings' hoisted values.
  long hoisted_width() const { return config.flow_steps * couplings.front().first.padded(); }
  int input_width() const { return condition + low() + config.hidden; }

  const PackedKernels& kernels;
  const FlowConfig config;
  int width;         ///< of a frame's features
  bool encoded;      ///< whether there is one shared encoding of the condition
  int live;          ///< floats of past and music in a frame's condition
  int encoding;      ///< width of the shared encoding, or `live` without one
  int aimed;         ///< with innovations, the number of features that aim at the key, the pose's;
                     ///< otherwise 0
  int condition;     ///< columns of the condition in couplings' inputs: the sum of both
  int key_width;     ///< of a frame's key condition
  int static_width;  ///< the same after `encode_static`, if encoded
  Eigen::VectorXf feature_mean, feature_std, feature_scale;  ///< scale = 1 / std
  /// Weights of the prediction, [width, tau], and spread of the output, standardised. Empty without
  /// innovations.
  Eigen::MatrixXf predict;
  Eigen::VectorXf drawn_spread;
  Eigen::VectorXf audio_mean, audio_scale;
  float log_det = 0;  ///< the part of the log-determinant common to all frames
  PackedLinear encode_static, encode_live, encode;
  std::vector<Coupling> couplings;
};

/// Runs the flow on the calling CPU thread. A step allocates nothing.
///
/// Computes the terms that do not depend on earlier frames in one product over the next kAhead
/// frames, at a transition's start and after each kAhead frames. So long transitions start fast and
/// need little memory.
class PackedStepper : public FlowStepper {
 public:
  explicit PackedStepper(std::shared_ptr<const PackedFlow> flow);

  void StartTransition(Eigen::MatrixXf conditions) override;
  void Step(FlowFrame* frame) override;

 private:
  static constexpr long kAhead = 16;

  void Hoist(long frame);
  void Condition(const FlowFrame& frame);
  double Couple(int frame, int step);
  void Hidden(int frame, int step);
  // With innovations: Aim computes the value that would reach the key; AddPrediction converts `x`
  // in place from the flow's output to the standardised frame.
  void Aim(const FlowFrame& frame, const float* fixed, float* aim) const;
  void AddPrediction(std::span<const float> past, float* x) const;

  std::shared_ptr<const PackedFlow> flow_;
  std::vector<float> static_condition_;  // [N, static_width]
  std::vector<float> hoisted_;           // [kAhead, hoisted_width]; encoded: none
  long hoisted_from_ = 0;                // frame of its first row
  std::vector<float> state_;             // [flow_steps, h0 h1 c0 c1, hidden]
  // Rows of one step.
  RowBuffer live_;      // past and music, standardised
  RowBuffer encoding_;  // after the encoding's first layer
  RowBuffer input_;     // of a coupling: condition, z_lo, own hidden state
  RowBuffer wide_;      // gates
  RowBuffer hidden_;    // of the last layer; before it [h0 | h1]
  RowBuffer ab_;
  RowBuffer z_, mixed_;
};

}  // namespace choreo
