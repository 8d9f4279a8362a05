#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "model/motion/skeleton.h"

/// What bears a body, frame by frame: its centre of mass, its feet on the floor, and the zero
/// moment point (Vukobratovic 1972), which lies within the feet of whoever does not topple.
namespace choreo {

inline constexpr double kGravity = 9.81;  ///< m/s^2
/// A foot is on the floor whose toes, or whose ankle less its 5 cm, are less than 5 cm above it.
inline constexpr double kSoleHeight = 0.05, kAnkleAboveSole = 0.05;
/// A body is thrown, and falls as stones do, whose centre accelerates downwards faster, m/s^2.
inline constexpr double kThrown = 6;
/// Metres by which feet reach further than their joints: closer, the zero moment point is in them.
inline constexpr double kSoleReach = 0.15;

/// The point of the convex hull of `others`, at least one, that is nearest to a point of the floor:
/// that point itself, if it is within.
Eigen::Vector2d NearestInHull(const Eigen::Vector2d& point, std::vector<Eigen::Vector2d> others);
/// How far it is from there, metres; infinite without others.
double DistanceToHull(const Eigen::Vector2d& point, std::vector<Eigen::Vector2d> others);

/// What of a frame's joints balance asks for.
struct BodyPoints {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of mass, metres
  Eigen::Matrix<double, 3, 4> feet;  ///< of Skeleton::feet, metres, ankles as high as their soles
};

/// A frame's.
struct Balance {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();        ///< of mass, smoothed, metres
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< its, m/s^2
  Eigen::Matrix<double, 3, 4> feet;                        ///< BodyPoints::feet
  std::array<bool, 4> on_floor = {};                       ///< of Skeleton::feet
  double foot_height = 0;  ///< of the lowest foot above the floor, metres
  /// How far centre and zero moment point are outside of the hull of what is on the floor, metres;
  /// none where nothing is, and no zero moment point of a body that is thrown.
  std::optional<double> centre_outside, zmp_outside;

  bool Thrown() const { return acceleration.y() < -kThrown; }
  /// Something holds the body, or it flies as bodies do: the zero moment point is no more than
  /// kSoleReach outside of what is on the floor, or the body is thrown.
  bool Supported() const { return Thrown() || (zmp_outside && *zmp_outside <= kSoleReach); }
};

/// Measures balance from joint positions. The centre of mass is smoothed by a Gaussian of 1.5
/// frames, its ends mirrored through their first and last value; the zero moment point is c - h
/// c'' / (c''_y + g), h being c's height above the floor. Immutable; thread-safe.
class BalanceGauge {
 public:
  static constexpr int kReach = 7;  ///< four standard deviations, and the frame beyond them

  /// Whether it can be made for a skeleton: one with MassWeights.
  static bool Fits(const Skeleton& skeleton);

  /// For a skeleton that Fits. `floor`: its height, metres.
  BalanceGauge(const Skeleton& skeleton, double fps, double floor);

  /// `joints`: [3, joints].
  BodyPoints Of(const Eigen::Matrix3Xd& joints) const;
  /// Balance at frame `at` of `frames`, from at most kReach frames to either side.
  Balance At(std::span<const BodyPoints> frames, size_t at) const;

 private:
  std::array<int, 4> feet_;
  Eigen::VectorXd weights_;
  double floor_;
  // What the frames from kReach before to kReach behind weigh in the smoothed centre, and in its
  // second derivative.
  std::array<double, 2 * kReach + 1> smooth_ = {};
  std::array<double, 2 * kReach + 1> bend_ = {};
};

/// Counts supported frames while a dance goes by: a few numbers in all. The floor is y = 0, on
/// which feet stand as in the rest pose. Not thread-safe.
class SupportMeter {
 public:
  /// For a skeleton that BalanceGauge fits.
  SupportMeter(const Skeleton& skeleton, double fps);

  /// The next frame's [3, joints].
  void Add(const Eigen::Matrix3Xd& joints);
  /// Share of the frames so far; 1 of none.
  double Share() const;

 private:
  BalanceGauge gauge_;
  std::vector<BodyPoints> last_;  // as many as At of the next frame asks for
  int64_t judged_ = 0, supported_ = 0;
};

}  // namespace choreo
