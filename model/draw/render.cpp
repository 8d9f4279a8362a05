#include "model/draw/render.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "model/body/doll.h"
#include "model/core/error.h"
#include "model/draw/check_within.h"
#include "model/draw/floor_light.h"

namespace choreo {
namespace {

using Eigen::Vector3f;

constexpr float kLampSpread = 0.10f;   // radians
constexpr float kShadowBias = 0.012f;  // metres off the surface: parts overlap at the joints
constexpr float kFloorGrid = 0.5f;  // metres between the lines on the floor, which the world fixes
constexpr float kGridHalfWidth = 0.008f;  // metres

Vector3f Linear(const Colour& colour) {
  const auto linear = [](double value) { return static_cast<float>(std::pow(value, 2.2)); };
  return {linear(colour.r), linear(colour.g), linear(colour.b)};
}

// Linear light, 0 to 1, as a byte of sRGB.
uint8_t Encode(float linear) {
  // Fine enough for the steep dark end: a step of the table is less than one of the byte.
  constexpr int kSteps = 1 << 15;
  static const std::vector<uint8_t> bytes = [] {
    std::vector<uint8_t> made;
    for (int i = 0; i <= kSteps; ++i)
      made.push_back(std::lround(255 * std::pow(double{1} * i / kSteps, 1 / 2.2)));
    return made;
  }();
  return bytes[static_cast<size_t>(std::clamp(linear, 0.0f, 1.0f) * kSteps + 0.5f)];
}

float SmoothStep(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

class Renderer {
 public:
  Renderer(const std::vector<PlacedPart>& figure, const View& view, const FrameStyle& style,
           const Picture& picture)
      : parts_(Bound(figure)),
        camera_(view, picture.width, picture.height),
        half_width_(0.5f * static_cast<float>(picture.width)),
        samples_(style.samples),
        middle_(view.target.cast<float>()),
        reach_(static_cast<float>(0.72 * view.extent *
                                  std::max(1.0, double{1} * picture.width / picture.height))),
        lamp_(LampDirection(view.azimuth)),
        floor_light_(parts_, lamp_, kLampSpread),
        background_(Linear(style.background)),
        floor_(Linear(style.floor)) {
    for (size_t i = 0; i < figure.size(); ++i) {
      colours_.push_back(Linear(figure[i].colour));
      nearby_.push_back(Nearby(parts_[i]));
      skins_.push_back(SkinAround(figure, i));
    }
    Enclose(picture);
  }

  void Render(Picture& picture) {
    Cast();
    picture.rgb.resize(size_t{3} * picture.width * picture.height);
    uint8_t* rgb = picture.rgb.data();
    for (int y = 0; y < picture.height; ++y) {
      const FloorRow floor = RowAt(static_cast<float>(y) + 0.5f, 1);
      for (int x = 0; x < picture.width; ++x) {
        for (const float value : Pixel(x, y, floor)) *rgb++ = Encode(value);
      }
    }
  }

 private:
  static std::vector<BoundedCone> Bound(const std::vector<PlacedPart>& figure) {
    std::vector<BoundedCone> parts;
    for (const PlacedPart& part : figure) parts.emplace_back(part.shape);
    return parts;
  }

  // From the left above the camera.
  static Vector3f LampDirection(double azimuth) {
    const double side = azimuth - 0.75;
    return Eigen::Vector3d(0.62 * std::sin(side), 1, 0.62 * std::cos(side))
        .normalized()
        .cast<float>();
  }

  // The parts that may stand between a part's surface and the lamp or the sky.
  std::vector<const BoundedCone*> Nearby(const BoundedCone& part) const {
    const float around = part.radius + 2 * kShadowBias;
    std::vector<const BoundedCone*> nearby;
    for (const BoundedCone& other : parts_) {
      const Vector3f to = other.middle - part.middle;
      const float beside = to.cross(lamp_).norm();
      const bool shades =
          beside < around + other.radius && to.dot(lamp_) > -(around + other.radius);
      if (&other != &part && (shades || to.norm() < around + other.SkyReach()))
        nearby.push_back(&other);
    }
    return nearby;
  }

  // The pixels outside of which there is no body, [from, to).
  Eigen::AlignedBox2i BoxOf(const RoundedCone& shape) const {
    const Eigen::AlignedBox2f box =
        camera_.Bounds(shape.a, shape.radius_a).merged(camera_.Bounds(shape.b, shape.radius_b));
    return {box.min().cast<int>(), box.max().cast<int>() + Eigen::Vector2i::Ones()};
  }

  // Makes room for the samples of the body.
  void Enclose(const Picture& picture) {
    const Eigen::Vector2i size(picture.width, picture.height);
    box_ = {size, Eigen::Vector2i::Zero()};
    for (const BoundedCone& part : parts_) box_.extend(BoxOf(part.shape));
    box_.max() = box_.max().cwiseMin(size).cwiseMax(box_.min());
    columns_ = box_.sizes().x() * samples_;
    rows_ = box_.sizes().y() * samples_;
    const size_t count = static_cast<size_t>(columns_) * rows_;
    distance_.assign(count, -1.0f);
    part_.assign(count, -1);
    normal_.resize(count);
  }

  // A sample's place in the picture; columns and rows of samples count from the box's corner.
  Eigen::Array2f PixelAt(int column, int row) const {
    const Eigen::Array2f sample = Eigen::Array2i(column, row).cast<float>() + 0.5f;
    return box_.min().array().cast<float>() + sample / static_cast<float>(samples_);
  }

  // Enters the parts' nearest points, row by row of samples.
  void Cast() {
    std::vector<Eigen::AlignedBox2i> boxes;  // of samples
    std::vector<SeenCone> seen;
    for (const BoundedCone& part : parts_) {
      seen.emplace_back(part.shape, camera_.eye());
      const Eigen::AlignedBox2i box = BoxOf(part.shape).intersection(box_);
      boxes.emplace_back(samples_ * (box.min() - box_.min()), samples_ * (box.max() - box_.min()));
    }
    std::vector<Vector3f> rays(static_cast<size_t>(columns_));
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column)
        rays[column] = camera_.Ray(PixelAt(column, row));
      for (size_t i = 0; i < parts_.size(); ++i) {
        const Eigen::Vector2i& from = boxes[i].min();
        const Eigen::Vector2i& to = boxes[i].max();
        if (row < from.y() || row >= to.y()) continue;
        for (int column = from.x(); column < to.x(); ++column) {
          const RayHit hit = seen[i].Enter(rays[column]);
          const size_t at = static_cast<size_t>(row) * columns_ + column;
          if (hit.distance < 0 || (part_[at] >= 0 && distance_[at] <= hit.distance)) continue;
          distance_[at] = hit.distance;
          part_[at] = static_cast<int>(i);
          normal_[at] = hit.normal;
        }
      }
    }
  }

  static Eigen::Vector2f OnFloor(const Vector3f& point) { return {point.x(), point.z()}; }

  // Where the points of a row of the picture lie on the floor, x and z: the camera does not lean to
  // a side, so that they lie on a line, evenly spaced. `next` is the row `size` pixels below.
  struct FloorLine {
    Eigen::Vector2f middle, step;  // at the picture's middle, and from pixel to pixel
    Eigen::Vector2f At(float from_middle) const { return middle + from_middle * step; }
  };
  struct FloorRow {
    bool seen;  // below the horizon
    float size;
    FloorLine here, next;
  };
  FloorRow RowAt(float y, float size) const {
    const auto line = [&](float at) -> FloorLine {
      const Vector3f ray = camera_.Direction({half_width_, at});
      const float along = -camera_.eye().y() / ray.y();
      return {OnFloor(camera_.eye() + along * ray), OnFloor(along * camera_.right())};
    };
    return {camera_.Direction({half_width_, y}).y() < 0, size, line(y), line(y + size)};
  }

  // Floor and parts are smooth: a pixel that shows one of them alone needs no more than one sample.
  Vector3f Pixel(int x, int y, const FloorRow& floor) const {
    const float middle = static_cast<float>(x) + 0.5f;
    const int left = (x - box_.min().x()) * samples_, top = (y - box_.min().y()) * samples_;
    if (left < 0 || left >= columns_ || top < 0 || top >= rows_) return Floor(floor, middle);
    const int first = part_[static_cast<size_t>(top) * columns_ + left];
    bool one = true;
    for (int row = top; row < top + samples_; ++row) {
      const int* parts = &part_[static_cast<size_t>(row) * columns_ + left];
      one = one && std::count(parts, parts + samples_, first) == samples_;
    }
    if (one)
      return first < 0 ? Floor(floor, middle) : Sample(left + samples_ / 2, top + samples_ / 2);
    Vector3f sum = Vector3f::Zero();
    for (int row = top; row < top + samples_; ++row) {
      for (int column = left; column < left + samples_; ++column) sum += Sample(column, row);
    }
    return sum / static_cast<float>(samples_ * samples_);
  }

  Vector3f Sample(int column, int row) const {
    const size_t at = static_cast<size_t>(row) * columns_ + column;
    const Eigen::Array2f pixel = PixelAt(column, row);
    if (part_[at] < 0) return Floor(RowAt(pixel.y(), 1 / static_cast<float>(samples_)), pixel.x());
    const Vector3f ray = camera_.Ray(pixel);
    const Vector3f point = camera_.eye() + distance_[at] * ray;
    return Body(part_[at], point, SkinNormal(skins_[part_[at]], point, normal_[at]), ray);
  }

  Vector3f Body(int index, const Vector3f& point, const Vector3f& normal,
                const Vector3f& ray) const {
    const Vector3f start = point + kShadowBias * normal;
    float lit = 1, open = 1;
    for (const BoundedCone* part : nearby_[index]) {
      if (lit > 0 && part->MeetsRay(start, lamp_) &&
          Intersect(part->shape, start, lamp_).distance > 0) {
        lit = 0;
      }
      if (part->HidesSky(start)) open *= 1 - 0.7f * OcclusionBy(part->shape, start, normal);
    }
    const float lamp = lit * std::max(0.0f, normal.dot(lamp_));
    const float sky = open * (0.5f + 0.5f * normal.y());
    // What the floor gives back reaches feet better than heads.
    const float bounce =
        open * (0.5f - 0.5f * normal.y()) * 0.5f * (1 - SmoothStep(0, 2, point.y()));
    const float fill = open * std::max(0.0f, -normal.dot(ray));
    const float edge = std::pow(1 - std::max(0.0f, -normal.dot(ray)), 3.0f);
    const float light = 0.68f * lamp + 0.34f * sky + 0.30f * bounce + 0.24f * fill;
    const Vector3f shine = Vector3f::Constant(0.05f * edge * open);
    return light * colours_[index] + shine;
  }

  // How much of a stretch of the floor, `width` wide around `at`, the grid's lines cover.
  static float Lines(float at, float width) {
    const float from_line = std::abs(at - kFloorGrid * std::round(at / kFloorGrid));
    const float covered = (kGridHalfWidth + 0.5f * width - from_line) / width;
    return std::clamp(covered, 0.0f, std::min(1.0f, 2 * kGridHalfWidth / width));
  }

  Vector3f Floor(const FloorRow& row, float x) const {
    if (!row.seen) return background_;
    const Eigen::Vector2f point = row.here.At(x - half_width_);
    const float away2 = (point - OnFloor(middle_)).squaredNorm();
    if (!(away2 <= reach_ * reach_)) return background_;
    float shade = floor_light_.At(point.x(), point.y());
    const Eigen::Vector2f size =
        row.size * row.here.step.cwiseAbs() + (row.next.At(x - half_width_) - point).cwiseAbs();
    const float free = (1 - Lines(point.x(), size.x())) * (1 - Lines(point.y(), size.y()));
    shade *= 1 - 0.20f * (1 - free);
    const float fade = SmoothStep(0.55f * reach_, reach_, std::sqrt(away2));
    return (1 - fade) * shade * floor_ + fade * background_;
  }

  std::vector<BoundedCone> parts_;
  std::vector<std::vector<const BoundedCone*>> nearby_;  // of each part
  std::vector<std::vector<const PlacedPart*>> skins_;    // the same
  std::vector<Vector3f> colours_;
  Camera camera_;
  float half_width_;
  int samples_;
  Vector3f middle_;
  float reach_;
  Vector3f lamp_;
  FloorLight floor_light_;
  Vector3f background_, floor_;
  Eigen::AlignedBox2i box_;
  int columns_ = 0, rows_ = 0;  // of samples, in the box
  std::vector<float> distance_;
  std::vector<int> part_;
  std::vector<Vector3f> normal_;
};

}  // namespace

void DrawFrame(const Skeleton& skeleton, const Pose& pose, const View& view,
               const FrameStyle& style, Picture& picture) {
  if (!pose.root_position.allFinite() || !pose.rotations.allFinite()) {
    throw InvalidArgument("pose", "holds values that are not finite");
  }
  DrawFrame(BuildFigure(skeleton, pose), view, style, picture);
}

void DrawFrame(const std::vector<PlacedPart>& figures, const View& view, const FrameStyle& style,
               Picture& picture) {
  CheckWithin("style.samples", style.samples, 1, 8);
  Renderer(figures, view, style, picture).Render(picture);
}

}  // namespace choreo
