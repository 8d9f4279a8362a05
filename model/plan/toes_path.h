#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/plan/contact_plan.h"

namespace choreo {

/// Seconds in which a foot moves from its previous place to its stance, and from there to the key.
inline constexpr double kSettleSeconds = 0.2;

/// The toes in each frame: at a stance's place during it; between stances on a path that begins and
/// ends at rest and follows the plan in its middle, as high above the floor as steps are. A foot
/// that starts in the air continues as planned; in a key's frame the key decides. `rest`: height of
/// standing toes. `keyed`: the last frame is a key; else a step may go on beyond it.
/// `shortest_step`: seconds that a step takes at least.
std::vector<Eigen::Vector3d> ToesPath(const FootTrack& foot, const std::vector<Stance>& stances,
                                      double rest, bool keyed, double fps, double shortest_step);

}  // namespace choreo
