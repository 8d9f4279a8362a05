#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "model/motion/skeleton.h"

/// Joints as people name and turn them: degrees in place of rotation vectors.
///
/// A knee or an elbow takes one number, how far it bends: 0 is straight. Any other joint takes
/// three: it turns about the x, the y and the z axis, one after the other (Rz Ry Rx, which Blender
/// calls XYZ). The axes are those of the bone above and stand still meanwhile; at rest x points to
/// the dancer's left, y up and z forward. Pure functions.
namespace choreo {

/// What a joint's numbers may be, degrees: rather more than dancers can.
struct AngleRange {
  double low = 0;
  double high = 0;
};

AngleRange RangeOf(const Skeleton& skeleton, int joint);

/// The index of a joint by name. Throws Error(kInvalidArgument) that names those that there are.
int RequireJoint(const Skeleton& skeleton, const std::string& name, const std::string& field);

/// Degrees → rotation vector. Throws Error(kInvalidArgument) naming the joint, the value and the
/// limit for another count of numbers and for one outside its range.
Eigen::Vector3d RotationFromDegrees(const Skeleton& skeleton, int joint,
                                    std::span<const double> degrees, const std::string& field);

/// Rotation vector → degrees; the second of three lies within -90 to 90. Of a hinge its bend alone,
/// whatever else it may be turned.
std::vector<double> DegreesFromRotation(const Skeleton& skeleton, int joint,
                                        const Eigen::Vector3d& rotation);

}  // namespace choreo
