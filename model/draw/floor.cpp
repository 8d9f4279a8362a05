#include "model/draw/floor.h"

#include <algorithm>
#include <cmath>

#include "model/core/numbers/smooth_step.h"

namespace choreo {
namespace {

constexpr float kFloorGrid = 0.5f;        // metres between the lines
constexpr float kGridHalfWidth = 0.008f;  // metres
constexpr float kFadeFrom = 0.55f;        // of the reach
constexpr int kStretch = 16;              // columns tested for one colour at once

Eigen::Vector2f OnFloor(const Eigen::Vector3f& point) { return {point.x(), point.z()}; }

// The distance from the nearest grid line, signed.
template <class Value>
Value FromLine(Value at) {
  // Adding this rounds to whole numbers, because floats of this size have no fraction.
  constexpr float kWhole = 3 << 22;
  const Value whole = (at / kFloorGrid + kWhole) - kWhole;
  return at - kFloorGrid * whole;
}

// The share of stretches of the floor, `width` wide around `at`, that grid lines leave free.
Lane BetweenLines(Lane at, Lane width) {
  const Lane covered = (kGridHalfWidth + 0.5f * width - Abs(FromLine(at))) / width;
  return 1 - Min(Max(covered, 0), Min(2 * kGridHalfWidth / width, AllLanes(1)));
}

}  // namespace

Floor::Floor(const View& view, const Camera& camera, const FloorLight& light, int width, int height,
             const Eigen::Vector3f& floor, const Eigen::Vector3f& background)
    : camera_(camera),
      light_(light),
      width_(width),
      half_width_(0.5f * static_cast<float>(width)),
      middle_(OnFloor(view.target.cast<float>())),
      reach_(static_cast<float>(0.72 * view.extent * std::max(1.0, double{1} * width / height))),
      floor_(floor),
      background_(background) {
  for (const auto& [colour, row] :
       {std::pair(&floor_, &plain_row_), std::pair(&background_, &background_row_)}) {
    row->resize(size_t{3} * width);
    for (int x = 0; x < width; ++x) tone_.Put(*colour, &(*row)[size_t{3} * x]);
  }
}

Floor::Row Floor::RowAt(float y, float size) const {
  const auto line = [&](float at) -> Line {
    const Eigen::Vector3f ray = camera_.Direction({half_width_, at});
    const float along = -camera_.eye().y() / ray.y();
    return {OnFloor(camera_.eye() + along * ray), OnFloor(along * camera_.right())};
  };
  return {camera_.Direction({half_width_, y}).y() < 0, size, line(y), line(y + size)};
}

bool Floor::IsPlain(const Row& row, float from, float to) const {
  const auto at = [](const Line& line, float from_middle) -> Eigen::Array2f {
    return line.middle + from_middle * line.step;
  };
  const Eigen::Array2f a = at(row.here, from), b = at(row.here, to), middle = middle_;
  const float clear = kFadeFrom * reach_;
  if (std::max((a - middle).square().sum(), (b - middle).square().sum()) > clear * clear)
    return false;
  if (light_.IsShaded({a.min(b).matrix(), a.max(b).matrix()})) return false;
  const Eigen::Array2f down = (at(row.next, from) - a).abs().max((at(row.next, to) - b).abs());
  const Eigen::Array2f width = row.size * row.here.step.array().abs() + down;
  const Eigen::Array2f reach = kGridHalfWidth + 0.5f * (width + (b - a).abs());
  for (int i = 0; i < 2; ++i)
    if (std::abs(FromLine(0.5f * (a[i] + b[i]))) < reach[i]) return false;
  return true;
}

Lanes Floor::Light(const Row& row, Lane from_middle) const {
  const auto at = [&](const Line& line, int i) -> Lane {
    return line.middle[i] + from_middle * line.step[i];
  };
  const Lane x = at(row.here, 0), z = at(row.here, 1);
  const auto free = [&](Lane here, int i) {
    const float step = row.size * std::abs(row.here.step[i]);
    return BetweenLines(here, step + Abs(at(row.next, i) - here));
  };
  Lane shade = MakeLane([&](int lane) { return light_.At(x[lane], z[lane]); });
  shade *= 1 - 0.20f * (1 - free(x, 0) * free(z, 1));
  const Lane right = x - middle_.x(), near = z - middle_.y();
  const Lane away = Sqrt(right * right + near * near);
  const Lane t = Within01((away - kFadeFrom * reach_) / ((1 - kFadeFrom) * reach_));
  const Lane fade = SmoothStep(t);
  return ((1 - fade) * shade) * Lanes::All(floor_) + fade * Lanes::All(background_);
}

Eigen::Vector3f Floor::At(const Eigen::Array2f& pixel, float size) const {
  const Row row = RowAt(pixel.y(), size);
  if (!row.is_seen) return background_;
  const Lanes light = Light(row, AllLanes(pixel.x() - half_width_));
  return {light.x[0], light.y[0], light.z[0]};
}

int Floor::DrawRow(int y, uint8_t* rgb) const {
  const Row row = RowAt(static_cast<float>(y) + 0.5f, 1);
  // Columns [from, to) in which the floor is within reach.
  int from = width_, to = width_;
  const Eigen::Vector2f beside = row.here.middle - middle_;
  const float step2 = row.here.step.squaredNorm(), nearest = -beside.dot(row.here.step) / step2;
  const float around2 = (reach_ * reach_ - beside.squaredNorm()) / step2 + nearest * nearest;
  if (row.is_seen && around2 > 0) {
    const auto column = [&](float from_middle) {
      return static_cast<int>(std::clamp(half_width_ + from_middle, 0.0f, float(width_)));
    };
    from = column(nearest - std::sqrt(around2));
    to = column(nearest + std::sqrt(around2));
  }
  const auto put = [&](const std::vector<uint8_t>& colours, int begin, int end) {
    std::copy_n(colours.data(), 3 * (end - begin), rgb + 3 * begin);
  };
  const Lane columns = MakeLane([](int lane) { return static_cast<float>(lane) + 0.5f; });
  put(background_row_, 0, from);
  int copied = 0;
  for (int begin = from, end; begin < to; begin = end) {
    end = std::min(begin + kStretch, to);
    if (IsPlain(row, static_cast<float>(begin) - half_width_,
                static_cast<float>(end) - half_width_)) {
      put(plain_row_, begin, end);
      copied += end - begin;
      continue;
    }
    for (int x = begin; x < end; x += kLanes) {
      const Lanes light = Light(row, columns + (static_cast<float>(x) - half_width_));
      uint8_t bytes[3 * kLanes];
      tone_.Put(light, bytes);
      std::copy_n(bytes, 3 * std::min(kLanes, end - x), rgb + 3 * x);
    }
  }
  put(background_row_, to, width_);
  return copied;
}

}  // namespace choreo
