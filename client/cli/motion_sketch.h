#pragma once

#include <cstdint>
#include <vector>

#include "model/motion/motion.h"

namespace choreo::cli {

/// A rough fingerprint of a motion: at moments spread over it, a weighted sum of its joints' angles
/// without the root's, radians. Files of any format, rate and precision give the same.
using MotionSketch = std::vector<double>;

/// Sketches a dance of `frames` at `fps`, whose file may have another rate: 16 moments, or one for
/// each frame.
MotionSketch SketchOf(const Motion& motion, int64_t frames, double fps);

/// Counts moments where two sketches differ by more than files' rates and precision explain.
size_t CountUnlike(const MotionSketch& a, const MotionSketch& b);

}  // namespace choreo::cli
