#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

/// Where a picture is taken from: a camera at human height that looks at `target`.
struct View {
  Eigen::Vector3d target{0, 0.95, 0};  ///< world, metres; comes to the middle of the picture
  /// Direction from the target to the camera: 0 stands at +Z, pi/2 at +X; radians.
  double azimuth = 0;
  /// What the picture's height shows at the target, metres, 0.1 to 100.
  double extent = 2.4;
};

/// The azimuth from which a pose is seen three quarters from its front.
double ThreeQuarterAzimuth(const Pose& pose);

/// A pose and the place on the floor that comes to the middle of its picture, metres.
struct FramedPose {
  const Pose* pose;
  double x, z;
};

/// What the height of pictures of this aspect (width over height) must show so that every one of
/// the poses fits in, metres, 2 to 4.
double FitExtent(const Skeleton& skeleton, const std::vector<FramedPose>& poses, double aspect);

/// The view of one of them, feet near the lower edge.
View StandingView(const FramedPose& framed, double azimuth, double extent);

/// A View worked out for a picture of a given size.
class Camera {
 public:
  /// Throws Error(kInvalidArgument) for a size below 1 pixel or a view outside its limits.
  Camera(const View& view, int width, int height);

  const Eigen::Vector3f& eye() const { return eye_; }
  /// What a ray's direction gains from a column to the next: a unit vector, level.
  const Eigen::Vector3f& right() const { return right_; }
  /// From a row to the one above it.
  const Eigen::Vector3f& up() const { return up_; }
  /// Direction through a point of the picture, pixels from the upper left corner.
  Eigen::Vector3f Direction(const Eigen::Array2f& pixel) const;
  /// The same of unit length.
  Eigen::Vector3f Ray(const Eigen::Array2f& pixel) const { return Direction(pixel).normalized(); }

  /// Columns and rows, pixels within the picture, outside which a ball is not seen.
  Eigen::AlignedBox2f Bounds(const Eigen::Vector3f& centre, float radius) const;

 private:
  Eigen::Vector3f eye_, right_, up_, forward_;
  float focal_;          // pixels
  Eigen::Array2f size_;  // pixels
};

}  // namespace choreo
