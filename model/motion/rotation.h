#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

/// Rotations: exponential map (axis-angle), matrix, quaternion, and the continuous 6D form of Zhou
/// et al. 2019. Double precision, radians. All functions are pure and thread-safe. `w` is an
/// axis-angle vector, whose norm is the angle.
namespace choreo {

inline constexpr double kDegrees = 180 / std::numbers::pi;  ///< degrees per radian

/// The matrix of the cross product: CrossMatrix(w) * v = w x v.
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

/// The vector nearest to `previous` that is the same rotation as `w`, plus whole turns about its
/// axis.
Eigen::Vector3d NearestBranch(const Eigen::Vector3d& w, const Eigen::Vector3d& previous);

/// Shortest-arc interpolation for t in [0, 1]; extrapolates outside.
Eigen::Vector3d Slerp(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double t);

/// Between rotation matrices; t in [0, 1].
Eigen::Matrix3d SlerpMatrix(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double t);

/// log(exp(a)^T exp(b)): the rotation from a to b, in a's local frame; angle in [0, pi].
Eigen::Vector3d RotationDifference(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// The right Jacobian of the exponential map: exp(w + d) = exp(w) exp(J d) for small d.
Eigen::Matrix3d RightJacobian(const Eigen::Vector3d& w);

/// log(exp(a) exp(delta)), on the branch nearest to a.
Eigen::Vector3d RotationCompose(const Eigen::Vector3d& a, const Eigen::Vector3d& delta);

/// The same rotation the other way round, by 2 pi minus the angle. `turn` itself if it is nearly
/// zero, because its axis is then noise.
Eigen::Vector3d OtherWayRound(const Eigen::Vector3d& turn);
/// `turn` or OtherWayRound(turn), whichever is nearer to `expected`.
Eigen::Vector3d NearerWayRound(const Eigen::Vector3d& turn, const Eigen::Vector3d& expected);

/// The rotation nearest to a matrix (Kabsch). For a sum of rotations, this is their chordal mean.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& m);

/// The first two columns of the matrix, stacked.
Eigen::Matrix<double, 6, 1> SixDFromMatrix(const Eigen::Matrix3d& r);
/// The inverse, by Gram-Schmidt. Throws Error(kInvalidArgument) if the two columns are zero or
/// parallel.
Eigen::Matrix3d MatrixFromSixD(const Eigen::Matrix<double, 6, 1>& d);

/// The horizontal direction of r's +Z axis as an angle in (-pi, pi]: 0 faces +Z, pi/2 faces +X.
/// Finite but meaningless if that axis is vertical.
double Heading(const Eigen::Matrix3d& r);
/// The rotation by `heading` about +Y.
Eigen::Matrix3d HeadingRotation(double heading);

/// The equivalent angle in (-pi, pi], radians.
double WrapAngle(double angle);

}  // namespace choreo
