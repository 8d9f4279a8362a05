#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/fit/sources/sources.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// The landmarks of a mapping, located on our skeleton. Immutable after construction; thread-safe.
class LandmarkSet {
 public:
  struct Point {
    int joint;
    double weight;
    Eigen::Vector3d offset;
  };
  struct Mark {
    std::vector<Point> points;
    int parent;
    double weight;
  };

  /// Throws Error(kInvalidArgument) for a joint that the skeleton lacks, a parent after its child,
  /// weights that do not sum to 1, or no landmarks.
  LandmarkSet(const Skeleton& skeleton, const SourceMapping& mapping);

  int size() const { return static_cast<int>(marks_.size()); }
  const Mark& operator[](int index) const { return marks_[index]; }

  static Eigen::Vector3d Position(const Point& point, const JointPlacement& placement) {
    return placement.positions.col(point.joint) + placement.rotations[point.joint] * point.offset;
  }
  /// The positions of all landmarks, [3, landmarks], metres.
  Eigen::Matrix3Xd Positions(const JointPlacement& placement) const;

  /// The landmark at a joint's position, or -1.
  int AtJoint(int joint) const;

 private:
  std::vector<Mark> marks_;
};

}  // namespace choreo
