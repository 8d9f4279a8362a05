#pragma once

#include <span>
#include <vector>

#include "model/motion/motion.h"

namespace choreo {

/// The plan with frame t's pose taken from where it has `times[t]`, in frames: one time a pose,
/// from -1, the last pose of the history, to the plan's last frame. `history`: the poses before
/// frame 0, oldest first, at least one. In between poses a cubic (Catmull-Rom, rotations in the
/// tangent space of the pose before) keeps what is smooth smooth. Thread-safe.
std::vector<Pose> Retime(std::span<const Pose> history, std::span<const Pose> plan,
                         std::span<const double> times);

}  // namespace choreo
