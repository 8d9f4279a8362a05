#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/core/safetensors.h"
#include "model/engine/packed/kernels.h"
#include "model/engine/packed/matrix.h"
#include "model/flow/flow_config.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// The flow's weights as PackedTile wants them, read from a checkpoint's tensors by name. Read
/// only; the engines of a process share them.
///
/// Every coupling's network sees [condition of the frame | z_lo | own hidden state], a row of
/// `input_width` floats; what of the condition is known at admission has left the columns and comes
/// in as the hoisted row.
struct PackedFlow {
  /// One step of the flow, as its inverse runs it.
  struct Coupling {
    PackedLinear first;   ///< [input_width] -> gates of the first LSTM layer
    PackedLinear second;  ///< [hidden | own hidden state] -> gates of the second
    PackedLinear last;    ///< [hidden] -> [a, b]
    PackedLinear unmix;   ///< inverse of ActNorm and invertible linear map, folded in double
  };

  /// Throws Error(kInvalidArgument) naming a tensor that is missing or does not fit the
  /// configuration. `products`: for the networks' products, `kernels` or
  /// less exact ones of the same panel; what leads straight from noise to features is `kernels`'.
  PackedFlow(const Safetensors& content, const FlowConfig& config, const Skeleton& skeleton,
             const PackedKernels& kernels, const PackedKernels& products);

  int low() const { return width / 2; }
  int high() const { return width - low(); }
  /// Floats of one slot's recurrent state: for each step h and c of both layers.
  int state_width() const { return flow_steps * 4 * hidden; }
  /// Gates of one LSTM layer.
  int gates() const { return 4 * hidden; }
  /// Width of Hoist's rows: every coupling's first layer.
  long hoisted_width() const { return flow_steps * couplings.front().first.padded(); }
  int input_width() const { return condition + low() + hidden; }

  /// static_condition [rows, static_width] -> hoisted [rows, hoisted_width()]: what every frame's
  /// first products start from, biases included. Not where the condition is encoded: there it is
  /// what is added to `encode_live`. Allocates nothing.
  void Hoist(const float* static_condition, long rows, float* hoisted) const;

  const PackedKernels& kernels;
  int width, tau, audio_features, flow_steps, hidden;
  bool encoded;      ///< one shared condition encoding, else the raw condition
  int live;          ///< floats of past and music that a frame's condition is made of
  int condition;     ///< columns of the condition that couplings see: the encoding's, or `live`
  int key_width;     ///< of a frame's key condition
  int static_width;  ///< of it behind encode_static; the same where nothing is encoded
  Eigen::VectorXf feature_mean, feature_std, feature_scale;  ///< scale = 1 / std
  Eigen::VectorXf audio_mean, audio_scale;
  float log_det = 0;  ///< the part that is the same in every frame
  PackedLinear encode_static, encode_live, encode;
  std::vector<Coupling> couplings;

 private:
  std::vector<PackedLinear> hoisted_;  // raw: each coupling's static columns
};

}  // namespace choreo
