#pragma once

#include <torch/nn/module.h>
#include <torch/nn/modules/container/modulelist.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/modules/normalization.h>
#include <torch/nn/pimpl.h>
#include <torch/types.h>

#include <memory>

#include "model/core/files/safetensors.h"
#include "model/flow/checkpoint/checkpoint.h"
#include "model/flow/window/flow_model.h"

namespace choreo {

/// The continuous flow's network: a transformer over a window's frames, two per token. For a point
/// z between noise and motion it predicts F, the unknown part of the flow (equations in
/// model/flow/flow_sampler.h), from history, key and controls. The motion prior is stored in its
/// buffers.
class ContinuousFlowImpl : public torch::nn::Module {
 public:
  /// Initially the prior is a random walk's.
  ContinuousFlowImpl(const ContinuousFlowConfig& config, const Skeleton& skeleton);

  /// Shapes as in FlowNetwork::Evaluate, time before features: z [batch, w, dimensions], poses and
  /// mean [batch, tau + w, dimensions], joints [batch, tau + w, 3 joints], frames [batch, tau + w,
  /// FrameFeatures()], whole [batch, WholeFeatures()], t [batch] → F [batch, w, dimensions].
  torch::Tensor forward(const torch::Tensor& z, const torch::Tensor& poses,
                        const torch::Tensor& joints, const torch::Tensor& mean,
                        const torch::Tensor& frames, const torch::Tensor& whole,
                        const torch::Tensor& t);

  /// `covariance` and `usual` as in MotionPrior; `mixing` as in FlowModelParts; `spread`
  /// [dimensions]: the spread of displacements over a window.
  void SetPrior(const Eigen::MatrixXd& covariance, const VariancePowers& powers,
                const Eigen::MatrixXd& mixing, const Eigen::VectorXd& spread,
                const UsualPose& usual);
  void SetEnergy(const EnergyPrior& energy);
  void SetTurns(const TurnPrior& turns);
  void SetFacing(double variance);  ///< UsualPose::facing
  void SetCurve(const EnergyCurve& curve);
  void SetResponse(const EnergyResponse& response);
  /// Everything besides the network that sampling needs.
  FlowModelParts Parts() const;

  const ContinuousFlowConfig& config() const { return config_; }
  const Skeleton& skeleton() const { return skeleton_; }

 private:
  void SetPowers(const VariancePowers& powers);

  ContinuousFlowConfig config_;
  Skeleton skeleton_;
  torch::Tensor covariance_, powers_, usual_, usual_variance_, mixing_, spread_, velocity_, energy_,
      turns_, curve_, response_, facing_;
  torch::nn::Linear embed_{nullptr}, inject_{nullptr}, condition_in_{nullptr},
      condition_out_{nullptr}, head_{nullptr}, head_modulation_{nullptr};
  torch::nn::ModuleList blocks_;
};
TORCH_MODULE(ContinuousFlow);

/// Runs the network one window at a time, so that a window's bits do not depend on others. Keeps
/// the model on its device.
std::unique_ptr<FlowNetwork> MakeTorchFlowNetwork(ContinuousFlow model,
                                                  torch::Device device = torch::kCPU);

/// Checkpoints of this network (model/flow/checkpoint/checkpoint.h).
using ContinuousFlowCheckpoint = CheckpointOf<ContinuousFlow>;
bool HoldsContinuousFlow(const Safetensors& content);
/// `name`: the checkpoint's name in errors. Throws Error(kInvalidArgument), naming the fault, for
/// another format version, a wrong hash, or tensors that do not fit the configuration.
ContinuousFlowCheckpoint ParseContinuousFlow(const Safetensors& content, const std::string& name);
/// Writes a checkpoint atomically. Returns the content hash. `weights`: the tensors by name.
std::string SaveContinuousFlow(const std::filesystem::path& path, const ContinuousFlow& model,
                               Safetensors weights, const nlohmann::json& card);

}  // namespace choreo
