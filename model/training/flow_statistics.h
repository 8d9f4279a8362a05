#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "model/flow/continuous_flow.h"
#include "model/training/clip_track.h"
#include "model/training/window_batch.h"

/// What the continuous flow knows of its data before it trains, measured on batches of real
/// windows.
namespace choreo {

/// How far real windows stray from the mean of `prior`, whose powers are all zero.
VariancePowers MeasureVariancePowers(const MotionPrior& prior,
                                     const std::vector<WindowBatch>& batches);

/// How lively real windows are, of which all body parts' energy is told, by what is known of them.
EnergyPrior MeasureEnergy(const FlowModelParts& model, const std::vector<WindowRequest>& requests);

/// How the energy of body parts goes up and down in real dances; unknown if no clip is longer than
/// its correlation.
EnergyCurve MeasureCurve(std::span<const ClipTrack> tracks,
                         const std::array<double, kBodyParts>& medians);

/// How lively windows come out that are told how lively real ones were: of `requests`, which tell
/// the energy of all body parts. `model` knows no response. Unknown where they are few.
EnergyResponse MeasureResponse(const FlowModelParts& model, const FlowNetwork& network,
                               const std::vector<WindowRequest>& requests);

/// Which way round real dancers turn to a key, by what is known of the windows: `turning` is
/// theirs.
TurnPrior MeasureTurns(const Skeleton& skeleton, const std::vector<WindowRequest>& requests);

/// Of real windows: the correlation of white coordinates over dimensions, its Cholesky factor; and
/// the spread of displacements [dimensions].
struct WindowStatistics {
  Eigen::MatrixXd mixing;
  Eigen::VectorXd spread;
};
WindowStatistics MeasureWindows(const std::vector<WindowBatch>& batches);

}  // namespace choreo
