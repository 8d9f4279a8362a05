#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "model/motion/skeleton.h"

/// Converts joint rotations between rotation vectors and angles in degrees for people.
///
/// A knee or an elbow has one angle, its bend: 0 is straight. Any other joint has three: rotations
/// about the x, then the y, then the z axis (Rz Ry Rx, which Blender calls XYZ). The axes are fixed
/// to the bone above; at rest x points to the dancer's left, y up and z forward. Pure functions.
namespace choreo {

/// The allowed range of a joint's angles, degrees, somewhat wider than dancers reach.
struct AngleRange {
  double low = 0;
  double high = 0;
};

AngleRange RangeOf(const Skeleton& skeleton, int joint);

/// The index of a joint by name. Throws Error(kInvalidArgument), which lists the existing names.
int RequireJoint(const Skeleton& skeleton, const std::string& name, const std::string& field);

/// Converts degrees to a rotation vector. Throws Error(kInvalidArgument), naming joint, value and
/// limit, for a wrong number of angles or one outside its range.
Eigen::Vector3d RotationFromDegrees(const Skeleton& skeleton, int joint,
                                    std::span<const double> degrees, const std::string& field);

/// Converts a rotation vector to degrees. The second of three angles is in [-90, 90]. For a hinge,
/// returns only the bend and ignores other rotation.
std::vector<double> DegreesFromRotation(const Skeleton& skeleton, int joint,
                                        const Eigen::Vector3d& rotation);

}  // namespace choreo
