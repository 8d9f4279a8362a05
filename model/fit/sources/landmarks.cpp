#include "model/fit/sources/landmarks.h"

#include <algorithm>
#include <cmath>

#include "model/core/error.h"

namespace choreo {

LandmarkSet::LandmarkSet(const Skeleton& skeleton, const SourceMapping& mapping) {
  if (mapping.landmarks.empty()) throw InvalidArgument("mapping.landmarks", "0, at least 1 needed");
  for (const Landmark& landmark : mapping.landmarks) {
    const std::string field = "mapping.landmarks." + landmark.name;
    const int index = size();
    if (index == 0 ? landmark.parent != -1 : landmark.parent < 0 || landmark.parent >= index) {
      throw InvalidArgument(field + ".parent", std::to_string(landmark.parent) +
                                                   ", must be -1 for the first landmark and an "
                                                   "earlier landmark's index for the others");
    }
    Mark mark{.points = {}, .parent = landmark.parent, .weight = landmark.weight};
    double sum = 0;
    for (const OurPoint& point : landmark.ours) {
      const int joint = skeleton.Find(point.joint);
      if (joint < 0) {
        throw InvalidArgument(field + ".ours", "the skeleton '" + skeleton.name +
                                                   "' has no joint '" + point.joint + "'");
      }
      mark.points.push_back({joint, point.weight, point.offset});
      sum += point.weight;
    }
    if (!(std::abs(sum - 1) < 1e-9)) {
      throw InvalidArgument(field + ".ours",
                            "weights sum to " + std::to_string(sum) + ", must be 1");
    }
    marks_.push_back(std::move(mark));
  }
}

Eigen::Matrix3Xd LandmarkSet::Positions(const JointPlacement& placement) const {
  Eigen::Matrix3Xd positions(3, size());
  for (int i = 0; i < size(); ++i) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Point& point : marks_[i].points) sum += point.weight * Position(point, placement);
    positions.col(i) = sum;
  }
  return positions;
}

int LandmarkSet::AtJoint(int joint) const {
  const auto at = std::ranges::find_if(marks_, [joint](const Mark& mark) {
    const Point& point = mark.points[0];
    return mark.points.size() == 1 && point.joint == joint && point.offset.isZero();
  });
  return at == marks_.end() ? -1 : static_cast<int>(at - marks_.begin());
}

}  // namespace choreo
