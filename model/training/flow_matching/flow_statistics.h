#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "model/flow/network/continuous_flow.h"
#include "model/training/clips/clip_track.h"
#include "model/training/windows/window_batch.h"

/// Statistics of real windows that the continuous flow measures before training.
namespace choreo {

/// Measures the deviation of real windows from the mean of `prior`, whose powers are all zero.
VariancePowers MeasureVariancePowers(const MotionPrior& prior,
                                     const std::vector<WindowBatch>& batches);

/// Measures the distribution of real windows' energy, given what is known of the windows.
/// `requests` give all body parts' energy.
EnergyPrior MeasureEnergy(const FlowModelParts& model, const std::vector<WindowRequest>& requests);

/// Measures how the energy of body parts rises and falls in real dances. Unknown if no clip is
/// longer than its correlation.
EnergyCurve MeasureCurve(std::span<const ClipTrack> tracks,
                         const std::array<double, kBodyParts>& medians);

/// Measures the energy of sampled windows that request real windows' energy. `requests` give all
/// body parts' energy. `model` has no response yet. Unknown for too few windows.
EnergyResponse MeasureResponse(const FlowModelParts& model, const FlowNetwork& network,
                               const std::vector<WindowRequest>& requests);

/// Measures in which direction real dancers turn to a key, given what is known of the windows.
/// `requests` have the real `turn_to_key`.
TurnPrior MeasureTurns(const Skeleton& skeleton, const std::vector<WindowRequest>& requests);

/// Statistics of real windows: the correlation of white coordinates over dimensions, as a Cholesky
/// factor, and the spread of displacements [dimensions].
struct WindowStatistics {
  Eigen::MatrixXd mixing;
  Eigen::VectorXd spread;
};
WindowStatistics MeasureWindows(const std::vector<WindowBatch>& batches);

}  // namespace choreo
