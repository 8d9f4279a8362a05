#pragma once

#include "model/training/trainer/curves.h"
#include "model/training/windows/window_clips.h"

namespace choreo {

/// Compares sampled windows with real ones at each of kComparedFrames: the mean's distance over
/// interpolation's, the distance between two seeds, and speed and jerk over the real ones'.
NamedFigures CompareWindows(const FlowNetwork& network, const FlowModelParts& parts,
                            const WindowClips& clips, int windows);

}  // namespace choreo
