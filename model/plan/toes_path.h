#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/plan/contact_plan.h"

namespace choreo {

/// A foot comes to where it stands from where it stood, and from there to the key, in so many
/// seconds.
inline constexpr double kSettleSeconds = 0.2;

/// Where the toes are in each frame: in a stance at its place, between two on a way that begins and
/// ends still, and in the middle is the plan's own, as far above the floor as steps are. A foot
/// that is in the air already goes on as the plan moves it, and in the frame of a key all is the
/// key's. `rest`: the height of toes that stand. `keyed`: the last frame is a key.
std::vector<Eigen::Vector3d> ToesPath(const FootTrack& foot, const std::vector<Stance>& stances,
                                      double rest, bool keyed, double fps);

}  // namespace choreo
