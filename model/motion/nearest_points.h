#pragma once

#include <algorithm>
#include <utility>

namespace choreo {

/// The nearest points of the segments from `a` to `b` and from `c` to `d`, as shares of their
/// lengths (Ericson, Real-Time Collision Detection, 5.1.9). `Vector`: Eigen::Vector3d or Vector3f.
template <class Vector>
auto NearestPoints(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  using Number = typename Vector::Scalar;
  const Vector along_p = b - a, along_q = d - c, between = a - c;
  const Number pp = along_p.squaredNorm(), qq = along_q.squaredNorm();
  const Number pq = along_p.dot(along_q), pr = along_p.dot(between), qr = along_q.dot(between);
  const auto share = [](Number part, Number whole) {
    return whole > 0 ? std::clamp<Number>(part / whole, 0, 1) : 0;
  };
  const Number on_p = share(pq * qr - pr * qq, pp * qq - pq * pq);
  const Number on_q = share(pq * on_p + qr, qq);
  return std::pair<Number, Number>(share(pq * on_q - pr, pp), on_q);
}

}  // namespace choreo
