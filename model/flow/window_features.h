#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "model/flow/continuous_flow_config.h"
#include "model/flow/flow_window.h"

/// What the network is told of a window besides its poses: numbers of order one, zero where
/// something is unknown. Written once, for training and for every engine.
namespace choreo {

struct WindowFeatures {
  Eigen::MatrixXf frames;  ///< [FrameFeatures(), tau + w]: beats, controls, time
  Eigen::VectorXf whole;   ///< [WholeFeatures()]: pose and velocity left, way to the key, style
};

int FrameFeatures(std::span<const ControlRow> controls = kControls);
int WholeFeatures(const Skeleton& skeleton, const ContinuousFlowConfig& config);

WindowFeatures DescribeWindow(const Skeleton& skeleton, const ContinuousFlowConfig& config,
                              const MotionPrior& prior, const WindowRequest& request,
                              const FlowWindow& window);

/// Where frame `at` stands between two of the `beats` (frames, ascending): [0, 1). Before the first
/// and after the last beat the nearest interval goes on; fewer than two beats have no phase.
/// `period`: of that interval, frames.
struct BeatPhase {
  double phase = 0, period = 0;
};
std::optional<BeatPhase> PhaseAt(std::span<const double> beats, double at);

}  // namespace choreo
