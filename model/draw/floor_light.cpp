#include "model/draw/floor_light.h"

#include <Eigen/Geometry>
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
  const auto shadow_of = [&](const BoundedCone& part) -> Vector3f {
    return part.middle - std::max(0.0f, part.middle.y()) / lamp.y() * lamp;
  };
  const auto penumbra_of = [&](const BoundedCone& part) {
    return part.radius * (1 + 1 / lamp.y()) + 2 * lamp_spread * std::max(0.0f, part.middle.y());
  };
  Eigen::AlignedBox2f reached;
  for (const BoundedCone& part : parts) {
    for (const auto& [point, around] : {std::pair(shadow_of(part), penumbra_of(part)),
                                        std::pair(part.middle, part.radius + kSkyMargin)}) {
      const Eigen::Array2f on_floor(point.x(), point.z());
      reached.extend(Eigen::AlignedBox2f(on_floor - around, on_floor + around));
    }
  }
  low_ = reached.min();
  columns_ = 2 + CellsIn(reached.sizes().x());
  rows_ = 2 + CellsIn(reached.sizes().y());
  // Each part darkens the cells around it and around its shadow.
  std::vector<float> hidden(static_cast<size_t>(columns_) * rows_, 0), open(hidden.size(), 1);
  const auto each_cell = [&](const Vector3f& middle, float reach, const auto& darken) {
    const auto cell = [](float from, float to, int count) {
      return std::clamp(static_cast<int>(std::floor((to - from) / kShadowCell)), 0, count);
    };
    const int right = cell(low_.x(), middle.x() + reach + kShadowCell, columns_);
    const int bottom = cell(low_.y(), middle.z() + reach + kShadowCell, rows_);
    for (int row = cell(low_.y(), middle.z() - reach, rows_); row < bottom; ++row) {
      for (int column = cell(low_.x(), middle.x() - reach, columns_); column < right; ++column) {
        const Vector3f point(low_.x() + static_cast<float>(column) * kShadowCell, 0,
                             low_.y() + static_cast<float>(row) * kShadowCell);
        darken(point, static_cast<size_t>(row) * columns_ + column);
      }
    }
  };
  for (const BoundedCone& part : parts) {
    each_cell(shadow_of(part), 1.5f * penumbra_of(part) + 0.1f, [&](const Vector3f& at, size_t i) {
      hidden[i] = std::max(hidden[i], ShadowOf(part.shape, at, lamp, lamp_spread));
    });
    each_cell(part.middle, part.SkyReach(), [&](const Vector3f& at, size_t i) {
      if (part.HidesSky(at)) open[i] *= 1 - OcclusionBy(part.shape, at, Vector3f::UnitY());
    });
  }
  for (size_t i = 0; i < hidden.size(); ++i)
    light_.push_back(0.45f * (1 - hidden[i]) + 0.55f * open[i]);
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
