#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/plan/contact_plan.h"

namespace choreo {

/// Seconds in which a foot moves from its previous place to its stance, and from its stance to a
/// key.
inline constexpr double kSettleSeconds = 0.2;

/// The toes' positions in each frame. During a stance they are at its place. Between stances they
/// move at the height of a step, on a path that starts and ends at rest and follows the plan in its
/// middle. A foot that starts in the air continues as planned. In a key's frame the key sets the
/// position. `rest`: height of standing toes. `keyed`: the last frame is a key; otherwise a step
/// may continue beyond it. `shortest_step`: least duration of a step, seconds.
std::vector<Eigen::Vector3d> ToesPath(const FootTrack& foot, const std::vector<Stance>& stances,
                                      double rest, bool keyed, double fps, double shortest_step);

}  // namespace choreo
