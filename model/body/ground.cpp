#include "model/body/ground.h"

#include <algorithm>
#include <limits>

#include "model/body/doll.h"

namespace choreo {
namespace {

double LowestPoint(const std::vector<PlacedPart>& body) {
  float lowest = std::numeric_limits<float>::infinity();
  for (const auto& [shape, colour] : body)
    lowest = std::min({lowest, shape.a.y() - shape.radius_a, shape.b.y() - shape.radius_b});
  return lowest;
}

}  // namespace

double DollAboveFloor(const Skeleton& skeleton, const Pose& pose) {
  return LowestPoint(BuildFigure(skeleton, pose)) -
         LowestPoint(BuildFigure(skeleton, RestPose(skeleton)));
}

}  // namespace choreo
