#pragma once

#include <Eigen/Core>
#include <cmath>

/// SIMD vectors of floats.
namespace choreo {

inline constexpr int kLanes = 4;
/// kLanes floats. Operators work lane by lane, also with a scalar; `?:` selects by a comparison.
typedef float Lane __attribute__((vector_size(kLanes * sizeof(float))));

inline Lane AllLanes(float value) { return Lane{} + value; }
inline Lane Max(Lane a, float b) { return a > b ? a : AllLanes(b); }
inline Lane Min(Lane a, Lane b) { return a < b ? a : b; }
inline Lane Within01(Lane values) { return Min(Max(values, 0), AllLanes(1)); }
inline Lane Abs(Lane values) { return values < 0 ? -values : values; }
inline Lane Sqrt(Lane values) {
  Lane roots;
  for (int i = 0; i < kLanes; ++i) roots[i] = std::sqrt(values[i]);
  return roots;
}
/// Whether a comparison holds in any lane.
template <class Comparison>
bool Any(const Comparison& holds) {
  return (holds[0] | holds[1] | holds[2] | holds[3]) != 0;
}
/// Sets each lane to `make(lane)`.
template <class Make>
Lane MakeLane(const Make& make) {
  Lane made;
  for (int i = 0; i < kLanes; ++i) made[i] = make(i);
  return made;
}

/// kLanes 3D vectors.
struct Lanes {
  Lane x{}, y{}, z{};

  static Lanes All(const Eigen::Vector3f& one) {
    return {AllLanes(one.x()), AllLanes(one.y()), AllLanes(one.z())};
  }
  void Put(int lane, const Eigen::Vector3f& one) {
    x[lane] = one.x(), y[lane] = one.y(), z[lane] = one.z();
  }
};

inline Lanes operator+(const Lanes& a, const Lanes& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Lanes operator-(const Lanes& a, const Lanes& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Lanes operator*(Lane a, const Lanes& b) { return {a * b.x, a * b.y, a * b.z}; }
inline Lane Dot(const Lanes& a, const Lanes& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace choreo
