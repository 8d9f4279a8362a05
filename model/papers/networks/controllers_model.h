#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/rnn.h>
#include <torch/nn/pimpl.h>
#include <torch/types.h>

#include <tuple>
#include <vector>

#include "model/motion/skeleton.h"
#include "model/papers/networks/controlled_frames.h"
#include "model/papers/networks/controllers_config.h"
#include "model/papers/networks/window_controller.h"

namespace choreo {

/// The network's inputs for a transition's N frames that do not depend on earlier outputs. Tensors
/// are [batch, N, ...]; Narrow selects frames.
///
/// The decoders' output is added to `root`, `ahead` and `joints`. These are the canonical frame's
/// origin at pelvis height, its heading and the mean posture or, for a residual network, the path
/// and interpolation.
struct ControlledGiven {
  torch::Tensor root;           ///< [batch, N, 3]
  torch::Tensor ahead;          ///< [batch, N, 2]
  torch::Tensor ramp;           ///< [batch, N, 1] factor of the decoders' output, in [0, 1]
  torch::Tensor joints;         ///< [batch, N, joints - 1, 3]
  torch::Tensor path_window;    ///< [batch, N, window, 3]
  torch::Tensor factor_window;  ///< [batch, N, window, 5]
  torch::Tensor path_memory, factor_memory;  ///< encoded by the controllers
  torch::Tensor code;                        ///< [batch, N, width] added at the second LSTM
  torch::Tensor target_joints;               ///< [batch, 1, joints - 1, 3]
  torch::Tensor target_facing;               ///< [batch, 1, 2]
  torch::Tensor end;                         ///< [batch, 1, 3] the path's last position
  torch::Tensor has_target;                  ///< [batch, 1, 1]
  torch::Tensor target;  ///< [batch, 1, encoding] the encoded target, unless residual

  ControlledGiven Narrow(int64_t first, int64_t count) const;
};

/// The network's frames and the velocities that it also predicts: [batch, n, joints, 3], the root's
/// and the others' relative to the root, metres per frame, in the scene's axes.
struct ControlledOutput {
  FrameTensors frames;
  torch::Tensor velocities;
};

/// The hidden and cell states of both LSTMs. None means zeros.
struct ControllersState {
  torch::optional<std::tuple<torch::Tensor, torch::Tensor>> first, second;
};

/// The network of paper C (Section 3.2, Figure 2).
class ControllersModelImpl : public torch::nn::Module {
 public:
  ControllersModelImpl(const ControllersConfig& config, const Skeleton& skeleton);

  const ControllersConfig& config() const { return config_; }
  const Skeleton& skeleton() const { return skeleton_; }
  /// The number of frames before the first one that Walk needs.
  int lead() const { return config_.window / 2 + 1; }
  /// [5, joints], as FactorsOf takes them.
  const torch::Tensor& shares() const { return shares_; }

  /// Sets mean and spread of real joints [joints - 1, 3], and the spread of velocity factors [5].
  void SetNormalisation(const torch::Tensor& joint_mean, const torch::Tensor& joint_std,
                        const torch::Tensor& factor_std);

  ControlledGiven Prepare(const ControlledTransition& transition);
  /// Computes n frames. `walked`: the lead() frames before the first one, then the first n - 1
  /// frames, real or computed.
  ControlledOutput Walk(const ControlledGiven& given, const FrameTensors& walked,
                        ControllersState* state);
  /// Computes all frames, each from the ones before it.
  FrameTensors RollOut(const ControlledTransition& transition);

 private:
  torch::Tensor EncodeTarget(const ControlledGiven& given, const FrameTensors* now);
  FrameTensors Compose(const ControlledGiven& given, const torch::Tensor& joints,
                       const torch::Tensor& turn, const torch::Tensor& root) const;

  ControllersConfig config_;
  Skeleton skeleton_;
  int64_t others_;                        // joints but the root
  double place_;                          // scale of positions relative to given.root, metres
  torch::Tensor joint_mean_, joint_std_;  // [joints - 1, 3]
  torch::Tensor factor_std_, shares_;     // [5], [5, joints]

  WindowController path_controller_, factor_controller_;
  torch::nn::Sequential state_encoder_{nullptr}, velocity_encoder_{nullptr},
      target_controller_{nullptr}, state_decoder_{nullptr}, root_decoder_{nullptr};
  torch::nn::Linear position_code_{nullptr};
  torch::nn::LSTM first_{nullptr}, second_{nullptr};
};
TORCH_MODULE(ControllersModel);

}  // namespace choreo
