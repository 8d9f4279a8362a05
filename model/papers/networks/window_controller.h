#pragma once

#include <torch/nn/module.h>
#include <torch/nn/pimpl.h>
#include <torch/types.h>

#include "model/papers/networks/controllers_config.h"

namespace choreo {

/// The root trajectory controller or velocity factor controller of paper C (Section 3.2, Figure 3).
/// Its inputs are the controls in a window around a frame, and the same window with computed frames
/// in place of past controls.
class WindowControllerImpl : public torch::nn::Module {
 public:
  virtual ~WindowControllerImpl() = default;
  /// The half that depends only on the controls, for all frames at once: [M, window, features] ->
  /// [M, window, width].
  virtual torch::Tensor Encode(const torch::Tensor& given) = 0;
  /// The other half: Encode's `memory` and the mixture segment [M, window, features] -> [M,
  /// controller].
  virtual torch::Tensor Decode(const torch::Tensor& memory, const torch::Tensor& mixture) = 0;
};
using WindowController = std::shared_ptr<WindowControllerImpl>;

/// Makes a controller of transformers, or of two fully connected layers if config.transformers is
/// false.
WindowController MakeWindowController(int features, const ControllersConfig& config);

}  // namespace choreo
