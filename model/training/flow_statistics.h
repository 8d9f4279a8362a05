#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "model/flow/continuous_flow.h"
#include "model/training/clip_track.h"
#include "model/training/window_batch.h"

/// The continuous flow's measurements on batches of real windows before training.
namespace choreo {

/// Measures how far real windows deviate from the mean of `prior`, whose powers are all zero.
VariancePowers MeasureVariancePowers(const MotionPrior& prior,
                                     const std::vector<WindowBatch>& batches);

/// The distribution of real windows' energy, which all body parts must give, by what is known of
/// the windows.
EnergyPrior MeasureEnergy(const FlowModelParts& model, const std::vector<WindowRequest>& requests);

/// Measures how the energy of body parts rises and falls in real dances; unknown if no clip is
/// longer than its correlation.
EnergyCurve MeasureCurve(std::span<const ClipTrack> tracks,
                         const std::array<double, kBodyParts>& medians);

/// The liveliness of sampled windows that were given real windows' energy, over `requests`, which
/// give all body parts'. `model` has no response yet. Unknown for too few windows.
EnergyResponse MeasureResponse(const FlowModelParts& model, const FlowNetwork& network,
                               const std::vector<WindowRequest>& requests);

/// Measures which way round real dancers turn to a key, by what is known of the windows; `turning`
/// is theirs.
TurnPrior MeasureTurns(const Skeleton& skeleton, const std::vector<WindowRequest>& requests);

/// Statistics of real windows: the correlation of white coordinates over dimensions, as a Cholesky
/// factor, and the spread of displacements [dimensions].
struct WindowStatistics {
  Eigen::MatrixXd mixing;
  Eigen::VectorXd spread;
};
WindowStatistics MeasureWindows(const std::vector<WindowBatch>& batches);

}  // namespace choreo
