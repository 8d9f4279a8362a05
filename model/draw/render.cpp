#include "model/draw/render.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "model/body/cone_lanes.h"
#include "model/body/doll.h"
#include "model/core/error.h"
#include "model/draw/check_within.h"
#include "model/draw/doll_light.h"
#include "model/draw/floor.h"
#include "model/draw/floor_light.h"
#include "model/draw/tone.h"

namespace choreo {
namespace {

using Eigen::Vector3f;

constexpr float kLampSpread = 0.10f;  // radians
constexpr int kMaxSamples = 8;        // per side of a pixel
constexpr int kAlike =
    6;  // of 255: a pixel of one part between two pixels this alike becomes their mean

std::vector<BoundedCone> Bound(const std::vector<PlacedPart>& doll) {
  std::vector<BoundedCone> parts;
  for (const PlacedPart& part : doll) parts.emplace_back(part.shape);
  return parts;
}

// The lamp is to the upper left of the camera.
Vector3f LampDirection(double azimuth) {
  const double side = azimuth - 0.75;
  return Eigen::Vector3d(0.62 * std::sin(side), 1, 0.62 * std::cos(side))
      .normalized()
      .cast<float>();
}

// The first hits of rays.
struct Seen {
  static constexpr float kNothing = -1;

  Lane distance = AllLanes(std::numeric_limits<float>::infinity());
  Lane part = AllLanes(kNothing);  // its index
};
using SeenRow = std::vector<Seen>;

class Renderer {
 public:
  Renderer(const std::vector<PlacedPart>& doll, const View& view, const FrameStyle& style,
           Picture& picture)
      : picture_(picture),
        parts_(Bound(doll)),
        camera_(view, picture.width, picture.height),
        samples_(style.samples),
        floor_light_(parts_, LampDirection(view.azimuth), kLampSpread),
        floor_(view, camera_, floor_light_, picture.width, picture.height, Linear(style.floor),
               Linear(style.background)),
        doll_light_(doll, parts_, LampDirection(view.azimuth)) {
    const Eigen::Vector2i size(picture.width, picture.height);
    box_ = {size, Eigen::Vector2i::Zero()};
    for (const BoundedCone& part : parts_) {
      cones_.emplace_back(part);
      boxes_.push_back(BoxOf(part.shape));
      box_.extend(boxes_.back());
    }
    box_.max() = box_.max().cwiseMin(size).cwiseMax(box_.min());
  }

  void Render() {
    picture_.rgb.resize(size_t{3} * picture_.width * picture_.height);
    for (int y = 0; y < picture_.height; ++y) floor_.DrawRow(y, PixelAt(0, y));
    const Eigen::Vector2i from = box_.min(), to = box_.max();
    for (int y = from.y(); y < to.y(); ++y) CastRow(y, &rows_.emplace_back());
    // Draws every second pixel of every second row first, because light changes slowly between
    // most.
    for (int y = from.y(); y < to.y(); y += 2) {
      for (int x = from.x(); x < to.x(); x += 2) Draw(x, y);
      for (int x = from.x() + 1; x < to.x(); x += 2) DrawBetween(x, y, Eigen::Vector2i::UnitX());
    }
    for (int y = from.y() + 1; y < to.y(); y += 2)
      for (int x = from.x(); x < to.x(); ++x) DrawBetween(x, y, Eigen::Vector2i::UnitY());
  }

 private:
  // The part that the last sample of a pixel shows.
  float PartAt(int x, int y) const {
    const int column = x - box_.min().x(), row = y - box_.min().y();
    if (column < 0 || row < 0) return Seen::kNothing;
    return rows_[row][column / kLanes].part[column % kLanes];
  }

  // Whether a pixel shows a single part: all its samples lie between its last sample and the last
  // ones of its left and upper neighbours.
  bool ShowsOnePart(int x, int y) const {
    const float part = PartAt(x, y);
    return part == PartAt(x - 1, y) && part == PartAt(x, y - 1) && part == PartAt(x - 1, y - 1);
  }

  void Draw(int x, int y) {
    const bool is_one = ShowsOnePart(x, y);
    if (is_one && PartAt(x, y) == Seen::kNothing) return;
    const int column = x - box_.min().x();
    const Seen& seen = rows_[y - box_.min().y()][column / kLanes];
    tone_.Put(is_one ? Body(seen, column % kLanes, Last(x, y)) : Mixed(x, y), PixelAt(x, y));
  }

  // Interpolates between two drawn pixels, one on either side.
  void DrawBetween(int x, int y, const Eigen::Vector2i& step) {
    const Eigen::Vector2i pixel(x, y), a = pixel - step, b = pixel + step;
    const float part = PartAt(x, y);
    const bool is_inside = (b.array() < box_.max().array()).all();
    if (!is_inside || part == Seen::kNothing || PartAt(a.x(), a.y()) != part ||
        PartAt(b.x(), b.y()) != part || !ShowsOnePart(x, y) || !ShowsOnePart(a.x(), a.y()) ||
        !ShowsOnePart(b.x(), b.y())) {
      return Draw(x, y);
    }
    const uint8_t *before = PixelAt(a.x(), a.y()), *after = PixelAt(b.x(), b.y());
    uint8_t* between = PixelAt(x, y);
    for (int i = 0; i < 3; ++i)
      if (std::abs(before[i] - after[i]) > kAlike) return Draw(x, y);
    for (int i = 0; i < 3; ++i) between[i] = static_cast<uint8_t>((before[i] + after[i] + 1) / 2);
  }

  uint8_t* PixelAt(int x, int y) const {
    return &picture_.rgb[3 * (static_cast<size_t>(y) * picture_.width + x)];
  }

  // The pixels outside which a shape does not show, [from, to).
  Eigen::AlignedBox2i BoxOf(const RoundedCone& shape) const {
    const Eigen::AlignedBox2f box =
        camera_.Bounds(shape.a, shape.radius_a).merged(camera_.Bounds(shape.b, shape.radius_b));
    return {box.min().cast<int>(), box.max().cast<int>() + Eigen::Vector2i::Ones()};
  }

  // Position of sample i of a pixel in the picture.
  Eigen::Array2f SampleAt(int x, int y, int i) const {
    const Eigen::Array2f sample = Eigen::Array2i(i % samples_, i / samples_).cast<float>() + 0.5f;
    return Eigen::Array2i(x, y).cast<float>() + sample / static_cast<float>(samples_);
  }
  Eigen::Array2f Last(int x, int y) const { return SampleAt(x, y, samples_ * samples_ - 1); }

  Lanes Rays(Lane x, Lane y) const {
    const Lanes direction = corner_ + x * right_ + y * down_;
    return 1 / Sqrt(Dot(direction, direction)) * direction;
  }

  void Meet(size_t part, const Lanes& rays, Seen* seen) const {
    const Lane distance = Enter(cones_[part], eye_, rays);
    const auto is_nearer = distance > 0 && distance < seen->distance;
    seen->distance = is_nearer ? distance : seen->distance;
    seen->part = is_nearer ? AllLanes(static_cast<float>(part)) : seen->part;
  }

  // Casts the last sample of each pixel of a row, from the box's left on.
  void CastRow(int y, SeenRow* row) {
    row->assign(1 + box_.sizes().x() / kLanes, {});
    const int left = box_.min().x();
    const Lane columns = MakeLane([&](int lane) { return Last(left + lane, y).x(); });
    const Lane middle = AllLanes(Last(left, y).y());
    std::vector<Lanes> rays(row->size());
    for (size_t i = 0; i < rays.size(); ++i)
      rays[i] = Rays(columns + static_cast<float>(i * kLanes), middle);
    for (size_t part = 0; part < parts_.size(); ++part) {
      const Eigen::Vector2i &from = boxes_[part].min(), &to = boxes_[part].max();
      if (y < from.y() || y >= to.y()) continue;
      const int end = std::min(to.x(), box_.max().x()) - left;
      for (int i = (from.x() - left) / kLanes; i * kLanes < end; ++i)
        Meet(part, rays[i], &(*row)[i]);
    }
  }

  // A pixel that may show several parts. Floor and parts are smooth, so a
  // pixel of a single part needs only one sample.
  Vector3f Mixed(int x, int y) const {
    const int count = samples_ * samples_;
    std::array<Seen, kMaxSamples * kMaxSamples / kLanes> seen;
    for (int i = 0; i < count; i += kLanes) {
      const Lanes rays = Rays(MakeLane([&](int lane) { return SampleAt(x, y, i + lane).x(); }),
                              MakeLane([&](int lane) { return SampleAt(x, y, i + lane).y(); }));
      for (size_t part = 0; part < parts_.size(); ++part) {
        const Eigen::Vector2i &from = boxes_[part].min(), &to = boxes_[part].max();
        if (x >= from.x() && x < to.x() && y >= from.y() && y < to.y())
          Meet(part, rays, &seen[i / kLanes]);
      }
    }
    const auto part = [&](int i) -> float { return seen[i / kLanes].part[i % kLanes]; };
    bool is_one = true;
    for (int i = 1; i < count; ++i) is_one = is_one && part(i) == part(0);
    Vector3f sum = Vector3f::Zero();
    for (int i = is_one ? count - 1 : 0; i < count; ++i) {
      const Eigen::Array2f at = SampleAt(x, y, i);
      sum += part(i) == Seen::kNothing ? floor_.At(at, 1 / static_cast<float>(samples_))
                                       : Body(seen[i / kLanes], i % kLanes, at);
    }
    return is_one ? sum : sum / static_cast<float>(count);
  }

  Vector3f Body(const Seen& seen, int lane, const Eigen::Array2f& pixel) const {
    const auto part = static_cast<size_t>(seen.part[lane]);
    const Vector3f ray = camera_.Ray(pixel);
    const Vector3f point = camera_.eye() + seen.distance[lane] * ray;
    return doll_light_.At(part, point, NormalAt(parts_[part].shape, point), ray);
  }

  Picture& picture_;
  std::vector<BoundedCone> parts_;
  std::vector<ConeLanes> cones_;  // the same
  Camera camera_;
  Lanes eye_ = Lanes::All(camera_.eye()), corner_ = Lanes::All(camera_.Direction({0, 0})),
        right_ = Lanes::All(camera_.right()), down_ = Lanes::All(-camera_.up());
  int samples_;
  FloorLight floor_light_;
  Floor floor_;
  DollLight doll_light_;
  Tone tone_;
  std::vector<Eigen::AlignedBox2i> boxes_;  // per part, pixels
  Eigen::AlignedBox2i box_;                 // of all of them
  std::vector<SeenRow> rows_;               // of the box: the last sample of each pixel
};

}  // namespace

void DrawFrame(const Skeleton& skeleton, const Pose& pose, const View& view,
               const FrameStyle& style, Picture& picture) {
  if (!pose.root_position.allFinite() || !pose.rotations.allFinite()) {
    throw InvalidArgument("pose", "holds values that are not finite");
  }
  DrawFrame(BuildDoll(skeleton, pose), view, style, picture);
}

void DrawFrame(const std::vector<PlacedPart>& dolls, const View& view, const FrameStyle& style,
               Picture& picture) {
  CheckWithin("style.samples", style.samples, 1, kMaxSamples);
  Renderer(dolls, view, style, picture).Render();
}

}  // namespace choreo
