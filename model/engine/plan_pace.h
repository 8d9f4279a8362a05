#pragma once

#include <span>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Pace at generation: a plan that swings round in a third of a second, though it has two, takes
/// its time. Pure functions; thread-safe.
namespace choreo {

/// Where on a plan the pose of each frame is taken from (retime.h) so that no step is longer than
/// `longest`, or than 1.3 times their mean, where the way as a whole asks for more. What is too
/// fast takes its time, what is not gives it, less of it near both ends, which go on as history and
/// key do. In ways of less than some 30 frames, where these leave too little, all goes faster than
/// that, by half at most. `steps`: how far it is from each pose to the next, the first one from the
/// history's last, in any unit.
std::vector<double> EvenTimes(std::span<const double> steps, double longest);

/// `plan` with such times where in some step its joints' mean speed is above 1.6 m/s and above all
/// that the history has. `history`: the poses before frame 0, oldest first, at least one.
std::vector<Pose> EvenPace(const Skeleton& skeleton, std::span<const Pose> history,
                           std::vector<Pose> plan, double fps);

}  // namespace choreo
