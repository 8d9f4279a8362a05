#include "model/draw/view.h"

#include <algorithm>
#include <cmath>

#include "model/body/doll.h"
#include "model/draw/check_within.h"
#include "model/draw/picture.h"

namespace choreo {
namespace {

constexpr double kCameraHeight = 1.6;  // metres above the floor
constexpr double kFieldOfView = 0.45;  // vertical, radians
constexpr float kNear = 0.05f;
constexpr double kBelow = 0.22;  // metres of floor below the dancer's feet
constexpr double kAir = 1.08;

}  // namespace

double FitExtent(const Skeleton& skeleton, const std::vector<FramedPose>& poses, double aspect) {
  const std::vector<DollPart> doll = MakeDoll(skeleton);
  double top = 1.8, side = 0.5;
  for (const FramedPose& framed : poses) {
    for (const PlacedPart& part : PlaceDoll(doll, ForwardKinematics(skeleton, *framed.pose))) {
      for (const auto& [ball, radius] : {std::pair(part.shape.a, part.shape.radius_a),
                                         std::pair(part.shape.b, part.shape.radius_b)}) {
        top = std::max(top, double{ball.y()} + radius);
        side = std::max(side, std::hypot(ball.x() - framed.x, ball.z() - framed.z) + radius);
      }
    }
  }
  return std::clamp(kAir * std::max(top + kBelow, 2 * side / aspect), 2.0, 4.0);
}

View StandingView(const FramedPose& framed, double azimuth, double extent) {
  return {
      .target = {framed.x, extent / 2 - kBelow, framed.z}, .azimuth = azimuth, .extent = extent};
}

Camera::Camera(const View& view, int width, int height) : size_(width, height) {
  CheckWithin("picture.width", width, 1, kMaxPicturePixels);
  CheckWithin("picture.height", height, 1, kMaxPicturePixels);
  CheckWithin("view.extent", view.extent, 0.1, 100);
  const double slope = std::tan(kFieldOfView / 2);
  const double distance = view.extent / 2 / slope;
  Eigen::Vector3d eye =
      view.target + distance * Eigen::Vector3d(std::sin(view.azimuth), 0, std::cos(view.azimuth));
  eye.y() = kCameraHeight;
  const Eigen::Vector3d forward = (view.target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitY()).normalized();
  eye_ = eye.cast<float>();
  forward_ = forward.cast<float>();
  right_ = right.cast<float>();
  up_ = right.cross(forward).cast<float>();
  focal_ = static_cast<float>(height / 2.0 / slope);
}

Eigen::Vector3f Camera::Direction(const Eigen::Array2f& pixel) const {
  const Eigen::Array2f beside = pixel - size_ / 2;
  return focal_ * forward_ + beside.x() * right_ - beside.y() * up_;
}

Eigen::AlignedBox2f Camera::Bounds(const Eigen::Vector3f& centre, float radius) const {
  const Eigen::Vector3f from = centre - eye_;
  const float depth = forward_.dot(from);
  const Eigen::Array2f corner = Eigen::Array2f::Zero();
  if (depth + radius < kNear) return {corner, corner};
  if (depth - radius < kNear) return {corner, size_};
  // The ball gets the bounds of the cube around it.
  const auto low = [&](float side) { return side / (depth + (side < 0 ? -radius : radius)); };
  const auto high = [&](float side) { return side / (depth + (side > 0 ? -radius : radius)); };
  const float x = right_.dot(from), y = -up_.dot(from);
  const auto clip = [&](float right, float down) -> Eigen::Array2f {
    return (size_ / 2 + focal_ * Eigen::Array2f(right, down)).max(corner).min(size_);
  };
  return {clip(low(x - radius), low(y - radius)), clip(high(x + radius), high(y + radius))};
}

}  // namespace choreo
