#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "model/body/body_distance.h"

namespace choreo::cli {

/// The two bodies on a stage that come nearest to each other.
struct NearestPair {
  size_t one = 0, other = 0;
  BodyDistance distance = {};
};

/// Of at least two. `places`: where each of them is, beside where it was made, metres.
NearestPair FindNearest(const std::vector<MovingBody>& bodies,
                        const std::vector<Eigen::Vector3d>& moved);

/// How many times as far from their middle places must be for bodies to stay `apart`, metres: 1 or
/// the least above it, to a millimetre. No two places are the same.
double WidenFormation(const std::vector<MovingBody>& bodies,
                      const std::vector<Eigen::Vector3d>& places, double apart);

/// What each body is moved by where places are `factor` times as far from their middle.
std::vector<Eigen::Vector3d> MovesOf(const std::vector<Eigen::Vector3d>& places, double factor);

}  // namespace choreo::cli
