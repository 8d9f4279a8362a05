#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "model/core/safetensors.h"
#include "model/engine/packed/kernels.h"
#include "model/engine/packed/matrix.h"
#include "model/motion/skeleton.h"
#include "model/papers/networks/flow_config.h"
#include "model/papers/samplers/flow_tile.h"

namespace choreo {

/// The flow's weights as PackedTile wants them, read from a checkpoint's tensors by name. Read
/// only; the engines of a process share them.
///
/// Every coupling's network sees [condition of the frame | z_lo | own hidden state], a row of
/// `input_width` floats. The part of a raw condition that is known when the transition begins has
/// no columns here: `hoisted` turns it into the value that the first product starts from.
struct PackedFlow {
  /// One step of the flow, as its inverse runs it.
  struct Coupling {
    PackedLinear first;    ///< [input_width] -> gates of the first LSTM layer
    PackedLinear hoisted;  ///< [static_width] -> the same, bias included; encoded: none
    PackedLinear second;   ///< [hidden | own hidden state] -> gates of the second
    PackedLinear last;     ///< [hidden] -> [a, b]
    PackedLinear unmix;    ///< inverse of ActNorm and invertible linear map, folded in double
  };

  /// Throws Error(kInvalidArgument) naming a tensor that is missing or does not fit the
  /// configuration. `products`: for the networks' products, `kernels` or less exact ones of the
  /// same panel; what leads straight from noise to features is `kernels`'.
  PackedFlow(const Safetensors& content, const FlowConfig& config, const Skeleton& skeleton,
             const PackedKernels& kernels, const PackedKernels& products);

  /// Of a model of innovations: behind each frame's encoding the standardised key, what of it is
  /// asked, and the frames left, [static_width(), frames].
  Eigen::MatrixXf WithAims(const Eigen::MatrixXf& encodings,
                           const Eigen::MatrixXf& conditions) const;
  float Standard(const float* features, int i) const {
    return (features[i] - feature_mean[i]) * feature_scale[i];
  }
  int low() const { return width / 2; }
  int high() const { return width - low(); }
  /// Floats of one slot's recurrent state: for each step h and c of both layers.
  int state_width() const { return config.flow_steps * 4 * config.hidden; }
  /// Of a frame: what every coupling's first product starts from.
  long hoisted_width() const { return config.flow_steps * couplings.front().first.padded(); }
  int input_width() const { return condition + low() + config.hidden; }

  const PackedKernels& kernels;
  const FlowConfig config;
  int width;         ///< of a frame's features
  bool encoded;      ///< one shared condition encoding, else the raw condition
  int live;          ///< floats of past and music that a frame's condition is made of
  int encoding;      ///< of those the shared encoding, or `live`
  int aimed;         ///< of a model of innovations, features that aim at the key: a pose's; else 0
  int condition;     ///< columns of the condition that couplings see: both
  int key_width;     ///< of a frame's key condition
  int static_width;  ///< of it behind `encode_static`; the same where nothing is encoded
  Eigen::VectorXf feature_mean, feature_std, feature_scale;  ///< scale = 1 / std
  /// Of a model of innovations, standardised: what of each past frame goes on, [width, tau], and
  /// how far what is drawn spreads; else empty.
  Eigen::MatrixXf predict;
  Eigen::VectorXf drawn_spread;
  Eigen::VectorXf audio_mean, audio_scale;
  float log_det = 0;  ///< the part that is the same in every frame
  PackedLinear encode_static, encode_live, encode;
  std::vector<Coupling> couplings;
};

/// The flow on the CPU that calls it, on one thread. Any number of rows costs what it is: nothing
/// is padded. A step allocates nothing.
///
/// What is known before the loop is computed ahead, in one product over kAhead frames: when a
/// transition starts, and again each time that many frames have been made, so that long transitions
/// neither take long to start nor much memory.
class PackedTile : public FlowTile {
 public:
  PackedTile(std::shared_ptr<const PackedFlow> flow, int slots);

  void Begin(int slot, Eigen::MatrixXf conditions) override;
  void Run(std::span<FlowRow> rows) override;

 private:
  static constexpr long kAhead = 16;

  struct Slot {
    std::vector<float> static_condition;  // [N, static_width]
    std::vector<float> hoisted;           // [kAhead, hoisted_width]; encoded: none
    long hoisted_from = 0;                // frame of its first row
    std::vector<float> state;             // [flow_steps, h0 h1 c0 c1, hidden]
  };

  void Hoist(Slot* slot, long frame);
  void Condition(std::span<const FlowRow> rows);
  void Couple(std::span<FlowRow> rows, int step);
  void Hidden(std::span<const FlowRow> rows, int step);
  // Of a model of innovations: what would reach the key, and `x` from what was drawn to the
  // standardised frame.
  void Aim(const FlowRow& row, const float* fixed, float* aim) const;
  void AddPrediction(std::span<const float> past, float* x) const;

  std::shared_ptr<const PackedFlow> flow_;
  std::vector<Slot> slots_;
  RowBuffer live_;      // past and music, standardised
  RowBuffer encoding_;  // behind the encoding's first layer
  RowBuffer input_;     // of a coupling: condition, z_lo, own hidden state
  RowBuffer wide_;      // gates
  RowBuffer hidden_;    // of the last layer; [h0 | h1] before
  RowBuffer ab_;
  RowBuffer z_, mixed_;
};

}  // namespace choreo
