#include "model/motion/rotation.h"

#include <Eigen/SVD>
#include <cmath>
#include <numbers>

#include "model/core/error.h"

namespace choreo {

Eigen::Matrix3d ExpMap(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  // Below this angle the quadratic term is under 1e-16 and the quotients below could underflow.
  const bool is_small = angle < 1e-8;
  const double half_sine = is_small ? 0 : std::sin(0.5 * angle) / angle;
  const double first = is_small ? 1 : std::sin(angle) / angle;
  const double second = is_small ? 0.5 : 2.0 * half_sine * half_sine;
  // I + first k + second k k, for k = CrossMatrix(w), without the products of its zeros. Zeros are
  // added, so that none becomes negative.
  const double fx = first * w.x(), fy = first * w.y(), fz = first * w.z();
  const double sx = second * w.x(), sy = second * w.y(), sz = second * w.z();
  Eigen::Matrix3d r;
  r << 1 - (sz * w.z() + sy * w.y()), (0 - fz) + sy * w.x(), (0 + fy) + sz * w.x(),
      (0 + fz) + sx * w.y(), 1 - (sz * w.z() + sx * w.x()), (0 - fx) + sz * w.y(),
      (0 - fy) + sx * w.z(), (0 + fx) + sy * w.z(), 1 - (sy * w.y() + sx * w.x());
  return r;
}

Eigen::Vector3d LogMap(const Eigen::Matrix3d& r) {
  // The quaternion's largest component is found first, which keeps the axis exact near pi.
  return ExpFromQuaternion(Eigen::Quaterniond(r));
}

Eigen::Quaterniond QuaternionFromExp(const Eigen::Vector3d& w) {
  const double angle = w.norm();
  // Always computes both, so that compilers merge them into one sincos.
  const double sine = std::sin(0.5 * angle), cosine = std::cos(0.5 * angle);
  const double scale = angle < 1e-8 ? 0.5 : sine / angle;
  return {cosine, scale * w.x(), scale * w.y(), scale * w.z()};
}

Eigen::Vector3d ExpFromQuaternion(const Eigen::Quaterniond& q) {
  const double sine = q.vec().norm();
  // atan2 needs no unit length and is accurate at both ends; q and -q are the same rotation.
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  if (sine < 1e-150) return Eigen::Vector3d::Zero();
  return (sign * 2.0 * std::atan2(sine, sign * q.w()) / sine) * q.vec();
}

Eigen::Vector3d NearestBranch(const Eigen::Vector3d& w, const Eigen::Vector3d& previous) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double angle = w.norm();
  if (angle < 1e-12) {
    // Whole turns about any axis are the identity, so use the previous vector's axis.
    const double turns = std::round(previous.norm() / kTurn);
    if (turns == 0) return w;
    return w + previous.normalized() * (turns * kTurn);
  }
  const Eigen::Vector3d axis = w / angle;
  const double turns = std::round((axis.dot(previous) - angle) / kTurn);
  if (turns == 0) return w;
  return axis * (angle + turns * kTurn);
}

Eigen::Vector3d Slerp(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double t) {
  return RotationCompose(a, t * RotationDifference(a, b));
}

Eigen::Matrix3d SlerpMatrix(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double t) {
  return Eigen::Quaterniond(a).slerp(t, Eigen::Quaterniond(b)).toRotationMatrix();
}

Eigen::Vector3d RotationDifference(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return ExpFromQuaternion(QuaternionFromExp(a).conjugate() * QuaternionFromExp(b));
}

Eigen::Vector3d RotationCompose(const Eigen::Vector3d& a, const Eigen::Vector3d& delta) {
  return NearestBranch(ExpFromQuaternion(QuaternionFromExp(a) * QuaternionFromExp(delta)), a);
}

Eigen::Matrix3d RightJacobian(const Eigen::Vector3d& w) {
  const double angle = w.norm(), square = angle * angle;
  const Eigen::Matrix3d k = CrossMatrix(w);
  // Uses the series below the angle where the closed forms cancel.
  const bool small = angle < 1e-2;
  const double first = small ? 0.5 - square / 24 : (1 - std::cos(angle)) / square;
  const double second =
      small ? 1.0 / 6 - square / 120 : (angle - std::sin(angle)) / (square * angle);
  return Eigen::Matrix3d::Identity() - first * k + second * k * k;
}

Eigen::Vector3d OtherWayRound(const Eigen::Vector3d& turn) {
  constexpr double kMinTurn = 1e-3;  // radians
  const double angle = turn.norm();
  return angle < kMinTurn ? turn : turn * (1 - 2 * std::numbers::pi / angle);
}

Eigen::Vector3d NearerWayRound(const Eigen::Vector3d& turn, const Eigen::Vector3d& expected) {
  const Eigen::Vector3d other = OtherWayRound(turn);
  return (other - expected).squaredNorm() < (turn - expected).squaredNorm() ? other : turn;
}

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

Eigen::Matrix<double, 6, 1> SixDFromMatrix(const Eigen::Matrix3d& r) {
  Eigen::Matrix<double, 6, 1> d;
  d << r.col(0), r.col(1);
  return d;
}

Eigen::Matrix3d MatrixFromSixD(const Eigen::Matrix<double, 6, 1>& d) {
  const Eigen::Vector3d first = d.head<3>();
  const Eigen::Vector3d second = d.tail<3>();
  const double length = first.norm();
  // Written so that NaN fails too.
  if (!(length > 1e-9)) {
    throw InvalidArgument(
        "six_d", "the first column's length is " + std::to_string(length) + ", must exceed 1e-9");
  }
  const Eigen::Vector3d x = first / length;
  const Eigen::Vector3d rest = second - x.dot(second) * x;
  const double rest_length = rest.norm();
  if (!(rest_length > 1e-9 * std::max(1.0, second.norm()))) {
    throw InvalidArgument("six_d", "the two columns are parallel, or the second one is zero");
  }
  Eigen::Matrix3d r;
  r.col(0) = x;
  r.col(1) = rest / rest_length;
  r.col(2) = r.col(0).cross(r.col(1));
  return r;
}

double Heading(const Eigen::Matrix3d& r) {
  const double heading = std::atan2(r(0, 2), r(2, 2));
  return heading <= -std::numbers::pi ? std::numbers::pi : heading;
}

Eigen::Matrix3d HeadingRotation(double heading) {
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  Eigen::Matrix3d r;
  r << c, 0, s, 0, 1, 0, -s, 0, c;
  return r;
}

double WrapAngle(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

}  // namespace choreo
