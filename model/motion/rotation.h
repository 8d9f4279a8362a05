#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

/// Rotations: exponential map (axis-angle), matrix, quaternion, and the continuous 6D form of Zhou
/// et al. 2019. Double precision, radians. All functions are pure and thread-safe; `w` is an
/// axis-angle vector, its norm the angle.
namespace choreo {

inline constexpr double kDegrees = 180 / std::numbers::pi;  ///< a radian

/// The matrix that multiplies v to w x v.
inline Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& w) {
  return (Eigen::Matrix3d() << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0).finished();
}

/// Rodrigues' formula; accurate to 1e-12 down to the zero vector. Grassia 1998, paper F's reference
/// [47].
Eigen::Matrix3d ExpMap(const Eigen::Vector3d& w);

/// The inverse of ExpMap with angle in [0, pi]; accurate near 0 and near pi.
Eigen::Vector3d LogMap(const Eigen::Matrix3d& r);

Eigen::Quaterniond QuaternionFromExp(const Eigen::Vector3d& w);
Eigen::Vector3d ExpFromQuaternion(const Eigen::Quaterniond& q);

/// The vector for the same rotation as `w` that is nearest to `previous` (adds turns of 2 pi about
/// the axis).
Eigen::Vector3d NearestBranch(const Eigen::Vector3d& w, const Eigen::Vector3d& previous);

/// Shortest-arc interpolation for t in [0, 1]; extrapolates outside.
Eigen::Vector3d Slerp(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double t);

/// Between rotation matrices; t in [0, 1].
Eigen::Matrix3d SlerpMatrix(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double t);

/// log(exp(a)^T exp(b)): the rotation that leads from a to b, in a's local frame; angle in [0, pi].
Eigen::Vector3d RotationDifference(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// How exp(w) turns with w, seen from the turned body: exp(w + d) = exp(w) exp(J d) for small d.
Eigen::Matrix3d RightJacobian(const Eigen::Vector3d& w);

/// log(exp(a) exp(delta)), on the branch nearest to a.
Eigen::Vector3d RotationCompose(const Eigen::Vector3d& a, const Eigen::Vector3d& delta);

/// The turn to the same end the other way round; `turn` itself if it is nearly zero, whose axis is
/// noise.
Eigen::Vector3d OtherWayRound(const Eigen::Vector3d& turn);
/// Whichever of the two is nearer to `expected`.
Eigen::Vector3d NearerWayRound(const Eigen::Vector3d& turn, const Eigen::Vector3d& expected);

/// The rotation nearest to a matrix (Kabsch): of a sum of rotations, their chordal mean.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& m);

/// First two columns of the matrix, stacked.
Eigen::Matrix<double, 6, 1> SixDFromMatrix(const Eigen::Matrix3d& r);
/// Gram-Schmidt; throws Error(kInvalidArgument) where the two columns are zero or parallel.
Eigen::Matrix3d MatrixFromSixD(const Eigen::Matrix<double, 6, 1>& d);

/// Angle of the horizontal direction of r's +Z axis: 0 faces +Z, pi/2 faces +X. The result is in
/// (-pi, pi]. It is finite but meaningless if that axis is vertical.
double Heading(const Eigen::Matrix3d& r);
/// The rotation by `heading` about +Y.
Eigen::Matrix3d HeadingRotation(double heading);

/// The same angle in (-pi, pi].
double WrapAngle(double angle);

}  // namespace choreo
