#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// A camera at human height that looks at `target`.
struct View {
  Eigen::Vector3d target{0, 0.95, 0};  ///< world, metres; the middle of the picture
  /// The direction from the target to the camera, radians: 0 is +Z, pi/2 is +X.
  double azimuth = 0;
  /// The height that the picture shows at the target, metres, 0.1 to 100.
  double extent = 2.4;
};

inline constexpr double kThreeQuarters = 0.6;  ///< radians from the dancer's heading

/// A pose and the floor position at the middle of its picture, metres.
struct FramedPose {
  const Pose* pose;
  double x, z;
};

/// The least height that pictures of this aspect (width over height) must show to contain every
/// pose, metres, 2 to 4.
double FitExtent(const Skeleton& skeleton, const std::vector<FramedPose>& poses, double aspect);

/// The view of one pose, feet near the lower edge.
View StandingView(const FramedPose& framed, double azimuth, double extent);

/// The camera of a View for a picture of a given size. Immutable; thread-safe.
class Camera {
 public:
  /// Throws Error(kInvalidArgument) for a size below 1 pixel or a view outside its limits.
  Camera(const View& view, int width, int height);

  const Eigen::Vector3f& eye() const { return eye_; }
  /// The horizontal unit vector towards the picture's right: the change of Direction per column.
  const Eigen::Vector3f& right() const { return right_; }
  /// The unit vector towards the picture's upper edge: the change of Direction per row upwards.
  const Eigen::Vector3f& up() const { return up_; }
  /// The direction of the ray through a point of the picture, pixels from the upper left corner.
  /// Not of unit length.
  Eigen::Vector3f Direction(const Eigen::Array2f& pixel) const;
  /// The same with unit length.
  Eigen::Vector3f Ray(const Eigen::Array2f& pixel) const { return Direction(pixel).normalized(); }

  /// The rectangle of the picture that contains a ball, pixels.
  Eigen::AlignedBox2f Bounds(const Eigen::Vector3f& centre, float radius) const;

 private:
  Eigen::Vector3f eye_, right_, up_, forward_;
  float focal_;          // pixels
  Eigen::Array2f size_;  // pixels
};

}  // namespace choreo
