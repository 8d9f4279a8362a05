#include "model/draw/view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/draw/check_within.h"
#include "model/draw/picture.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kCameraHeight = 1.6;   // metres above the floor
constexpr double kFieldOfView = 0.45;   // vertical, radians
constexpr double kThreeQuarters = 0.6;  // radians beside the dancer's own heading
constexpr float kNear = 0.05f;

}  // namespace

double ThreeQuarterAzimuth(const Pose& pose) {
  return WrapAngle(Heading(ExpMap(pose.rotations.col(0))) + kThreeQuarters);
}

Camera::Camera(const View& view, int width, int height)
    : width_(static_cast<float>(width)), height_(static_cast<float>(height)) {
  CheckWithin("picture.width", width, 1, kMostPicturePixels);
  CheckWithin("picture.height", height, 1, kMostPicturePixels);
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

Eigen::Vector3f Camera::Direction(float x, float y) const {
  return focal_ * forward_ + (x - width_ / 2) * right_ - (y - height_ / 2) * up_;
}

Camera::Box Camera::Bounds(const Eigen::Vector3f& centre, float radius) const {
  const Eigen::Vector3f from = centre - eye_;
  const float depth = forward_.dot(from);
  if (depth + radius < kNear) return {};
  if (depth - radius < kNear) return {0, 0, width_, height_};
  // The cube around the ball, seen from the front: its outermost corners bound the ball.
  const auto low = [&](float side) { return side / (depth + (side < 0 ? -radius : radius)); };
  const auto high = [&](float side) { return side / (depth + (side > 0 ? -radius : radius)); };
  const float x = right_.dot(from), y = -up_.dot(from);
  const auto clip = [](float value, float limit) { return std::clamp(value, 0.0f, limit); };
  return {clip(width_ / 2 + focal_ * low(x - radius), width_),
          clip(height_ / 2 + focal_ * low(y - radius), height_),
          clip(width_ / 2 + focal_ * high(x + radius), width_),
          clip(height_ / 2 + focal_ * high(y + radius), height_)};
}

}  // namespace choreo
