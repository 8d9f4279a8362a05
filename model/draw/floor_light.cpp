#include "model/draw/floor_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace choreo {
namespace {

using Eigen::Vector3f;

constexpr float kShadowCell = 0.025f;  // metres

int CellsIn(float length) {
  constexpr float kMost = 20;  // metres: nobody is larger, whatever the pose says
  return static_cast<int>(std::ceil(std::min(length, kMost) / kShadowCell));
}

}  // namespace

FloorLight::FloorLight(const std::vector<BoundedCone>& parts, const Vector3f& lamp,
                       float lamp_spread) {
  constexpr float kSkyMargin = 0.4f;
  Eigen::Vector2f low = Eigen::Vector2f::Constant(1e9f), high = -low;
  for (const BoundedCone& part : parts) {
    const Vector3f& middle = part.middle;
    const Vector3f shadow = middle - std::max(0.0f, middle.y()) / lamp.y() * lamp;
    const float margin =
        part.radius * (1 + 1 / lamp.y()) + 2 * lamp_spread * std::max(0.0f, middle.y());
    for (const auto& [point, around] :
         {std::pair(shadow, margin), std::pair(middle, part.radius + kSkyMargin)}) {
      const Eigen::Vector2f on_floor(point.x(), point.z());
      low = low.cwiseMin(on_floor - Eigen::Vector2f::Constant(around));
      high = high.cwiseMax(on_floor + Eigen::Vector2f::Constant(around));
    }
  }
  low_ = low;
  columns_ = 2 + CellsIn(high.x() - low.x());
  rows_ = 2 + CellsIn(high.y() - low.y());
  light_.resize(static_cast<size_t>(columns_) * rows_);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Vector3f point(low_.x() + static_cast<float>(column) * kShadowCell, 0,
                           low_.y() + static_cast<float>(row) * kShadowCell);
      float hidden = 0, open = 1;
      for (const BoundedCone& part : parts) {
        hidden = std::max(hidden, ShadowOf(part.shape, point, lamp, lamp_spread));
        if (part.HidesSky(point)) open *= 1 - OcclusionBy(part.shape, point, Vector3f::UnitY());
      }
      light_[static_cast<size_t>(row) * columns_ + column] = 0.45f * (1 - hidden) + 0.55f * open;
    }
  }
}

float FloorLight::At(float x, float z) const {
  const float u = (x - low_.x()) / kShadowCell, v = (z - low_.y()) / kShadowCell;
  if (!(u >= 0 && v >= 0 && u < static_cast<float>(columns_ - 1) &&
        v < static_cast<float>(rows_ - 1))) {
    return 1;
  }
  const auto column = static_cast<int>(u), row = static_cast<int>(v);
  const float s = u - static_cast<float>(column), t = v - static_cast<float>(row);
  const float* at = &light_[static_cast<size_t>(row) * columns_ + column];
  return (1 - t) * ((1 - s) * at[0] + s * at[1]) +
         t * ((1 - s) * at[columns_] + s * at[columns_ + 1]);
}

}  // namespace choreo
