#pragma once

#include <Eigen/Core>
#include <span>

#include "model/flow/priors/energy_curve.h"
#include "model/flow/priors/energy_prior.h"
#include "model/flow/priors/energy_response.h"
#include "model/flow/window/flow_window.h"
#include "model/flow/window/turn_prior.h"
#include "model/flow/window/window_features.h"

namespace choreo {

/// The network of a continuous flow, on any engine. Implementations are thread-safe.
class FlowNetwork {
 public:
  virtual ~FlowNetwork() = default;
  /// The conditioning of a window (WindowFeatures::whole) at each of `times`, in [0, 1], one per
  /// column, for Evaluate.
  virtual Eigen::MatrixXf Condition(const Eigen::VectorXf& whole,
                                    std::span<const float> times) const = 0;
  /// F of one window at the time of `condition`, [dimensions, w]. `z` [dimensions, w]: the flow's
  /// white coordinates; `poses` [dimensions, tau + w]: the displacements of the history, then of z,
  /// from the last history pose; `joints` [3 joints, tau + w]: the joints' positions in these
  /// poses, metres in the canonical frame; `mean`: the prior's mean in the shape of `poses`;
  /// `frames`: WindowFeatures::frames.
  virtual Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                                   const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                                   const Eigen::MatrixXf& frames,
                                   const Eigen::VectorXf& condition) const = 0;
};

/// Everything besides the request that sampling a window needs.
struct FlowModelParts {
  Skeleton skeleton;
  ContinuousFlowConfig config;
  MotionPrior prior;
  Eigen::MatrixXd mixing;  ///< [dimensions, dimensions] lower Cholesky factor of the noise's
                           ///< correlation over dimensions
  EnergyPrior energy = EnergyPrior();
  TurnPrior turns = {};
  EnergyCurve curve = {};
  EnergyResponse response = {};
};

}  // namespace choreo
