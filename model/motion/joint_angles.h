#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "model/motion/skeleton.h"

/// Converts joint rotations between rotation vectors and the degrees that people use.
///
/// A knee or an elbow has one number, its bend: 0 is straight. Any other joint has three: turns
/// about the x, then the y, then the z axis (Rz Ry Rx, which Blender calls XYZ). The axes are those
/// of the bone above and stay fixed; at rest x points to the dancer's left, y up and z forward.
/// Pure functions.
namespace choreo {

/// The allowed range of a joint's numbers, degrees: rather more than dancers reach.
struct AngleRange {
  double low = 0;
  double high = 0;
};

AngleRange RangeOf(const Skeleton& skeleton, int joint);

/// The index of a joint by name. Throws Error(kInvalidArgument) that lists the existing names.
int RequireJoint(const Skeleton& skeleton, const std::string& name, const std::string& field);

/// Degrees → rotation vector. Throws Error(kInvalidArgument), naming joint, value and limit, for a
/// wrong count of numbers or one outside its range.
Eigen::Vector3d RotationFromDegrees(const Skeleton& skeleton, int joint,
                                    std::span<const double> degrees, const std::string& field);

/// Rotation vector → degrees; the second of three is within -90 to 90. For a hinge returns only its
/// bend, ignoring other turns.
std::vector<double> DegreesFromRotation(const Skeleton& skeleton, int joint,
                                        const Eigen::Vector3d& rotation);

}  // namespace choreo
