#pragma once

#include <span>
#include <vector>

#include "model/motion/motion.h"

/// Timing at generation: the dancer of a plan goes fastest on the music's beats, which is what a
/// kinematic beat is (paper F, Section 4.2). Pure functions; thread-safe.
namespace choreo {

/// Where on a plan of `frames` frames the pose of frame `t` is taken from, in frames; t in [-1,
/// frames - 1], where -1 is the last pose of the history. Between two beats the plan's time runs
/// as t + A P / 2 pi sin(2 pi (t - beat) / P), so at 1 + A on each beat and at 1 - A half way
/// between: poses move by a frame or two, and speed peaks where the music does. The ends stay where
/// they are, so history and key do; transitions of less than 30 frames have a smaller A. `beats`:
/// ascending, in frames from frame 0; before the first, behind the last and where the music pauses
/// time runs evenly.
double PlanTime(std::span<const double> beats, int frames, double t);

/// Times `plan` to `beats`. `history`: the poses before frame 0, oldest first, at least one. In
/// between poses a cubic (Catmull-Rom, rotations in the tangent space of the nearest pose) keeps
/// what is smooth smooth.
std::vector<Pose> TimeToBeats(std::span<const Pose> history, const std::vector<Pose>& plan,
                              std::span<const double> beats);

}  // namespace choreo
