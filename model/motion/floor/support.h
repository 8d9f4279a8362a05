#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "model/motion/skeleton.h"

/// Measures what supports a body, frame by frame: its centre of mass, its feet on the floor, and
/// the zero moment point (Vukobratovic 1972), which lies within the feet unless the body topples.
namespace choreo {

inline constexpr double kGravity = 9.81;  ///< m/s^2
/// The least share of its weight that MomentLever assumes for a sinking body.
inline constexpr double kLightest = 0.25;
/// A foot is on the floor if its toes, or its ankle less 5 cm, are less than 5 cm above it.
inline constexpr double kSoleHeight = 0.05, kAnkleAboveSole = 0.05;
/// A body whose centre accelerates downwards faster than this, m/s^2, is thrown: it falls freely.
inline constexpr double kThrown = 6;
/// Metres that feet extend beyond their joints: a zero moment point this close is within them.
inline constexpr double kSoleReach = 0.15;

/// The factor h / (c''_y + g), seconds squared, in the zero moment point c - h c'' / (c''_y + g).
/// `height`: of the centre of mass above the floor, metres. `rise`: its upward acceleration, m/s^2.
inline double MomentLever(double height, double rise) {
  return height / std::max(kLightest * kGravity, kGravity + rise);
}

/// The point of the convex hull of `others` (at least one) that is nearest to `point`; `point`
/// itself if it is inside.
Eigen::Vector2d NearestInHull(const Eigen::Vector2d& point, std::vector<Eigen::Vector2d> others);
/// The vector to NearestInHull, metres, shortened by `slack`; zero if `slack` is longer.
Eigen::Vector2d WayToHull(const Eigen::Vector2d& point, std::vector<Eigen::Vector2d> others,
                          double slack);
/// The distance to NearestInHull, metres; infinite without others.
double DistanceToHull(const Eigen::Vector2d& point, std::vector<Eigen::Vector2d> others);

/// The points of a body from which balance is measured.
struct BodyPoints {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of mass, metres
  Eigen::Matrix<double, 3, 4>
      feet;  ///< in the order of Skeleton::feet, metres; ankles lowered to their soles
};

/// The balance of one frame.
struct Balance {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();        ///< of mass, smoothed, metres
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< of the centre, m/s^2
  Eigen::Matrix<double, 3, 4> feet;                        ///< BodyPoints::feet
  std::array<bool, 4> on_floor = {};                       ///< in the order of Skeleton::feet
  double foot_height = 0;  ///< of the lowest foot above the floor, metres
  /// How far the centre and the zero moment point are outside the hull of what is on the floor,
  /// metres. None if nothing is on the floor; a thrown body has no zero moment point.
  std::optional<double> centre_outside, zmp_outside;

  bool Thrown() const { return acceleration.y() < -kThrown; }
  /// Whether the body stands or flies naturally: the zero moment point is at most kSoleReach
  /// outside the hull of what is on the floor, or the body is thrown.
  bool Supported() const { return Thrown() || (zmp_outside && *zmp_outside <= kSoleReach); }
};

/// Measures balance from joint positions. Smooths the centre of mass with a Gaussian of 1.5 frames,
/// extending both ends by odd reflection. The zero moment point is c - h c'' / (c''_y + g), where h
/// is c's height above the floor. Immutable; thread-safe.
class BalanceGauge {
 public:
  static constexpr int kReach = 7;  ///< four standard deviations and one frame more

  /// Whether the skeleton has MassWeights, which the gauge needs.
  static bool Fits(const Skeleton& skeleton);

  /// `skeleton` must Fit. `floor`: its height, metres.
  BalanceGauge(const Skeleton& skeleton, double fps, double floor);

  /// `joints`: [3, joints].
  BodyPoints Of(const Eigen::Matrix3Xd& joints) const;
  /// Balance at frame `at` of `frames`, from at most kReach frames to either side.
  Balance At(std::span<const BodyPoints> frames, size_t at) const;

 private:
  std::array<int, 4> feet_;
  Eigen::VectorXd weights_;
  double floor_;
  // Weights of the frames from kReach before to kReach after: in the smoothed centre, and in its
  // second derivative.
  std::array<double, 2 * kReach + 1> smooth_ = {};
  std::array<double, 2 * kReach + 1> bend_ = {};
};

/// Counts the supported frames of a running dance in constant memory. The floor is y = 0; feet
/// stand on it as in the rest pose. Not thread-safe.
class SupportMeter {
 public:
  /// `skeleton` must fit BalanceGauge.
  SupportMeter(const Skeleton& skeleton, double fps);

  /// Adds the next frame's joint positions, [3, joints], metres.
  void Add(const Eigen::Matrix3Xd& joints);
  /// The share of supported frames so far; 1 before the first.
  double Share() const;

 private:
  BalanceGauge gauge_;
  std::vector<BodyPoints> last_;  // the frames that BalanceGauge::At needs for the next one
  int64_t judged_ = 0, supported_ = 0;
};

}  // namespace choreo
