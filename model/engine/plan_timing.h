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
/// between: poses move by a frame or two, and speed peaks where the music does. A way to a
/// key (`keyed`) has a larger A at either end that stands less than 2.5 frames from a beat: dancers
/// are slow at key poses, which is not what a beat asks for. That grows from nothing in ways of 30
/// frames to the whole of it in ways of 60. The ends stay where they are, so history and key do;
/// transitions of less than 30 frames, and beats less than 10 frames apart, have a smaller A.
/// `beats`: ascending, in frames from frame 0; before the first, behind the last and where the
/// music pauses time runs evenly.
double PlanTime(std::span<const double> beats, int frames, bool keyed, double t);

/// Times `plan` to `beats`. `history`: the poses before frame 0, oldest first, at least one.
std::vector<Pose> TimeToBeats(std::span<const Pose> history, std::span<const Pose> plan,
                              std::span<const double> beats, bool keyed);

}  // namespace choreo
