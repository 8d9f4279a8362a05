#include "model/draw/floor_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "model/body/cone_lanes.h"

namespace choreo {
namespace {

using Eigen::Vector3f;

constexpr float kShadowCell = 0.025f;  // metres

int CellsIn(float length) {
  constexpr float kMaxLength = 20;  // metres: limits the grid for any pose
  return static_cast<int>(std::ceil(std::min(length, kMaxLength) / kShadowCell));
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
  rows_ = 2 + CellsIn(reached.sizes().y());
  columns_ = kLanes * (1 + (1 + CellsIn(reached.sizes().x())) / kLanes);
  grid_ = {low_, low_ + kShadowCell * Eigen::Array2f(columns_, rows_).matrix()};
  // Each part darkens the cells around itself and its shadow.
  const size_t lanes = static_cast<size_t>(rows_) * columns_ / kLanes;
  std::vector<Lane> hidden(lanes, AllLanes(0)), open(lanes, AllLanes(1));
  const Lane steps = MakeLane([](int lane) { return static_cast<float>(lane) * kShadowCell; });
  const auto each_cells = [&](const Vector3f& middle, float reach, const auto& darken) {
    const auto cell = [](float from, float to, int count) {
      return std::clamp(static_cast<int>(std::floor((to - from) / kShadowCell)), 0, count);
    };
    const int left = cell(low_.x(), middle.x() - reach, columns_) / kLanes * kLanes;
    const int right = cell(low_.x(), middle.x() + reach + kShadowCell, columns_);
    const int bottom = cell(low_.y(), middle.z() + reach + kShadowCell, rows_);
    for (int row = cell(low_.y(), middle.z() - reach, rows_); row < bottom; ++row) {
      const float z = low_.y() + static_cast<float>(row) * kShadowCell;
      for (int column = left; column < right; column += kLanes) {
        const float x = low_.x() + static_cast<float>(column) * kShadowCell;
        darken(Lanes{x + steps, AllLanes(0), AllLanes(z)},
               (static_cast<size_t>(row) * columns_ + column) / kLanes);
      }
    }
  };
  const Lanes up = Lanes::All(Vector3f::UnitY());
  for (const BoundedCone& part : parts) {
    const ConeLanes cone(part);
    each_cells(shadow_of(part), 1.5f * penumbra_of(part) + 0.1f, [&](const Lanes& at, size_t i) {
      const Lane shadow = ShadowOf(cone, at, lamp, lamp_spread);
      hidden[i] = hidden[i] > shadow ? hidden[i] : shadow;
    });
    each_cells(part.middle, part.SkyReach(),
               [&](const Lanes& at, size_t i) { open[i] *= 1 - HiddenSky(cone, at, up); });
  }
  for (size_t i = 0; i < lanes; ++i) {
    const Lane light = 0.45f * (1 - hidden[i]) + 0.55f * open[i];
    for (int lane = 0; lane < kLanes; ++lane) light_.push_back(light[lane]);
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
