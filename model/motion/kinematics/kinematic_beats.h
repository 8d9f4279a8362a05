#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace choreo {

/// Smooths a curve of mean joint speeds (paper F, 4.5.1) with a Gaussian of 1/12 s, so that jitter
/// makes no beats. AIST++'s usual evaluation does so (Siyao et al. 2022: 5 frames at 60 fps). `fps`
/// > 0.
std::vector<double> SmoothSpeeds(std::span<const float> speed, double fps);

/// Frames of the kinematic beats: the local maxima of the smoothed curve (a plateau counts once, at
/// its start). `speed[i]` belongs to frame i + 1.
std::vector<int64_t> KinematicBeats(std::span<const float> speed, double fps);

}  // namespace choreo
