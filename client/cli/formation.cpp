#include "client/cli/formation.h"

#include <algorithm>
#include <limits>

namespace choreo::cli {

NearestPair FindNearest(const std::vector<MovingBody>& bodies,
                        const std::vector<Eigen::Vector3d>& moved) {
  NearestPair nearest{.distance = {std::numeric_limits<double>::infinity(), 0}};
  for (size_t i = 0; i < bodies.size(); ++i) {
    for (size_t j = i + 1; j < bodies.size(); ++j) {
      const BodyDistance distance = LeastDistance(bodies[i], bodies[j], moved[j] - moved[i]);
      if (distance.metres < nearest.distance.metres) nearest = {i, j, distance};
    }
  }
  return nearest;
}

double WidenFormation(const std::vector<MovingBody>& bodies,
                      const std::vector<Eigen::Vector3d>& places, double apart) {
  constexpr double kStep = 0.001;  // metres
  double factor = 1;
  // Two bodies part no faster than their places: each step is one that none can do with less of.
  for (double step = 1; step > 0;) {
    const std::vector<Eigen::Vector3d> moved = MovesOf(places, factor);
    step = 0;
    for (size_t i = 0; i < bodies.size(); ++i) {
      for (size_t j = i + 1; j < bodies.size(); ++j) {
        const double missing =
            apart - LeastDistance(bodies[i], bodies[j], moved[j] - moved[i]).metres;
        const double way = (places[j] - places[i]).norm();
        if (missing > 0) step = std::max(step, std::max(missing, kStep) / way);
      }
    }
    factor += step;
  }
  return factor;
}

std::vector<Eigen::Vector3d> MovesOf(const std::vector<Eigen::Vector3d>& places, double factor) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& place : places) middle += place / static_cast<double>(places.size());
  std::vector<Eigen::Vector3d> moved;
  for (const Eigen::Vector3d& place : places) moved.push_back((factor - 1) * (place - middle));
  return moved;
}

}  // namespace choreo::cli
