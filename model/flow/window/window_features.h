#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "model/flow/window/continuous_flow_config.h"
#include "model/flow/window/flow_window.h"

/// The network's inputs for a window besides its poses: numbers of order one, zero for unknowns.
/// Shared by training and all engines.
namespace choreo {

struct WindowFeatures {
  Eigen::MatrixXf frames;  ///< [FrameFeatures(), tau + w]: whether past, beats, controls, time
  Eigen::VectorXf whole;  ///< [WholeFeatures()]: the last pose, its velocity, way to the key, style
};

int FrameFeatures(std::span<const ControlRow> controls = kControls);
int WholeFeatures(const Skeleton& skeleton, const ContinuousFlowConfig& config);

WindowFeatures DescribeWindow(const Skeleton& skeleton, const ContinuousFlowConfig& config,
                              const MotionPrior& prior, const WindowRequest& request,
                              const FlowWindow& window);

/// The position of frame `at` between two of the `beats` (frames, ascending), [0, 1). Outside the
/// beats the nearest interval repeats; fewer than two beats have no phase. `period`: the interval,
/// frames.
struct BeatPhase {
  double phase = 0, period = 0;
};
std::optional<BeatPhase> PhaseAt(std::span<const double> beats, double at);

}  // namespace choreo
