#pragma once

#include <cstdint>
#include <vector>

#include "model/motion/motion.h"

namespace choreo::cli {

/// A rough fingerprint of a motion: for moments spread over it, a weighted sum of its joints'
/// angles except the root's, radians. It hardly depends on a file's format, rate and precision.
using MotionSketch = std::vector<double>;

/// Sketches a dance of `frames` at `fps`, whose file may have another rate. Uses 16 moments, or one
/// per frame if the dance has fewer frames.
MotionSketch SketchOf(const Motion& motion, int64_t frames, double fps);

/// Counts the moments at which two sketches differ by more than rates and precision explain.
size_t CountUnlike(const MotionSketch& a, const MotionSketch& b);

}  // namespace choreo::cli
