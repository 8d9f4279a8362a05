#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "model/motion/floor/support.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// The balance of each frame. `track`: the joint positions of each frame, [3, joints], metres.
/// `floor`: the floor's height, metres. Throws Error(kInvalidArgument) for a skeleton that
/// BalanceGauge doesn't fit, or no frames.
std::vector<Balance> BalanceOf(const Skeleton& skeleton, double fps,
                               const std::vector<Eigen::Matrix3Xd>& track, double floor);

/// Frames [first, end) in which a body hangs in the air.
struct Hover {
  size_t first = 0, end = 0;
};
/// The longest runs of frames whose height is more than `least`, without flights, in which the
/// centre of mass accelerates downwards by more than kThrown on average. One height and one balance
/// per frame.
std::vector<Hover> FindHovers(std::span<const double> heights, std::span<const Balance> balance,
                              double least);

}  // namespace choreo
