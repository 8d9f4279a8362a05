#include "model/draw/render.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/body/doll.h"
#include "model/core/error.h"
#include "model/draw/floor_light.h"

namespace choreo {
namespace {

using Eigen::Vector3f;

constexpr float kLampSpread = 0.10f;      // radians
constexpr float kShadowBias = 0.012f;     // metres off the surface: parts overlap at the joints
constexpr float kGridHalfWidth = 0.008f;  // metres

Vector3f Linear(const Colour& colour) {
  const auto linear = [](double value) { return static_cast<float>(std::pow(value, 2.2)); };
  return {linear(colour.r), linear(colour.g), linear(colour.b)};
}

uint8_t Encode(float linear) {
  // Fine enough for the steep dark end: a step of the table is less than one of the byte.
  constexpr int kSteps = 1 << 15;
  static const std::vector<uint8_t> table = [] {
    std::vector<uint8_t> bytes(kSteps + 1);
    for (int i = 0; i <= kSteps; ++i) {
      bytes[i] = static_cast<uint8_t>(std::lround(255 * std::pow(double{1} * i / kSteps, 1 / 2.2)));
    }
    return bytes;
  }();
  return table[static_cast<size_t>(std::clamp(linear, 0.0f, 1.0f) * kSteps + 0.5f)];
}

float SmoothStep(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

class Renderer {
 public:
  Renderer(const std::vector<PlacedPart>& figure, const View& view, const FrameStyle& style,
           const Picture& picture)
      : figure_(figure),
        parts_(Bound(figure)),
        camera_(view, picture.width, picture.height),
        samples_(style.samples),
        middle_(view.target.cast<float>()),
        reach_(static_cast<float>(0.72 * view.extent *
                                  std::max(1.0, double{1} * picture.width / picture.height))),
        lamp_(LampDirection(view.azimuth)),
        floor_light_(parts_, lamp_, kLampSpread),
        grid_(static_cast<float>(style.grid_m)),
        background_(Linear(style.background)),
        floor_(Linear(style.floor)) {
    for (const PlacedPart& part : figure) colours_.push_back(Linear(part.colour));
    Enclose(picture);
  }

  void Render(Picture& picture) {
    for (size_t i = 0; i < parts_.size(); ++i) Cast(static_cast<int>(i));
    picture.rgb.resize(size_t{3} * picture.width * picture.height);
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const Vector3f colour = Pixel(x, y);
        for (int c = 0; c < 3; ++c) {
          picture.rgb[3 * (static_cast<size_t>(y) * picture.width + x) + c] = Encode(colour[c]);
        }
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

  // The pixels outside of which there is no body.
  struct PixelBox {
    int left = 0, top = 0, right = 0, bottom = 0;
  };
  PixelBox BoxOf(const RoundedCone& shape) const {
    const Camera::Box a = camera_.Bounds(shape.a, shape.radius_a);
    const Camera::Box b = camera_.Bounds(shape.b, shape.radius_b);
    return {static_cast<int>(std::min(a.left, b.left)), static_cast<int>(std::min(a.top, b.top)),
            1 + static_cast<int>(std::max(a.right, b.right)),
            1 + static_cast<int>(std::max(a.bottom, b.bottom))};
  }

  // Makes room for the samples of the body.
  void Enclose(const Picture& picture) {
    box_ = {picture.width, picture.height, 0, 0};
    for (const BoundedCone& part : parts_) {
      const PixelBox box = BoxOf(part.shape);
      box_ = {std::min(box_.left, box.left), std::min(box_.top, box.top),
              std::max(box_.right, box.right), std::max(box_.bottom, box.bottom)};
    }
    box_.right = std::max(box_.left, std::min(box_.right, picture.width));
    box_.bottom = std::max(box_.top, std::min(box_.bottom, picture.height));
    columns_ = (box_.right - box_.left) * samples_;
    rows_ = (box_.bottom - box_.top) * samples_;
    const size_t count = static_cast<size_t>(columns_) * rows_;
    distance_.assign(count, -1.0f);
    part_.assign(count, -1);
    normal_.resize(count);
  }

  // Columns and rows of samples count from the box's corner.
  float PixelX(int column) const {
    return static_cast<float>(box_.left) +
           (static_cast<float>(column) + 0.5f) / static_cast<float>(samples_);
  }
  float PixelY(int row) const {
    return static_cast<float>(box_.top) +
           (static_cast<float>(row) + 0.5f) / static_cast<float>(samples_);
  }

  // Enters one part's nearest points.
  void Cast(int index) {
    const RoundedCone& shape = parts_[index].shape;
    const PixelBox box = BoxOf(shape);
    const int left = (box.left - box_.left) * samples_, top = (box.top - box_.top) * samples_;
    const int right = std::min(columns_, (box.right - box_.left) * samples_);
    const int bottom = std::min(rows_, (box.bottom - box_.top) * samples_);
    for (int row = top; row < bottom; ++row) {
      for (int column = left; column < right; ++column) {
        const Vector3f ray = camera_.Ray(PixelX(column), PixelY(row));
        if (!parts_[index].MeetsRay(camera_.eye(), ray)) continue;
        const RayHit hit = Intersect(shape, camera_.eye(), ray);
        const size_t at = static_cast<size_t>(row) * columns_ + column;
        if (hit.distance < 0 || (part_[at] >= 0 && distance_[at] <= hit.distance)) continue;
        distance_[at] = hit.distance;
        part_[at] = index;
        normal_[at] = hit.normal;
      }
    }
  }

  // Floor and parts are smooth: a pixel that shows one of them alone needs no more than one sample.
  Vector3f Pixel(int x, int y) const {
    const Vector3f whole(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 1);
    if (x < box_.left || x >= box_.right || y < box_.top || y >= box_.bottom) return Floor(whole);
    const int left = (x - box_.left) * samples_, top = (y - box_.top) * samples_;
    const int first = part_[static_cast<size_t>(top) * columns_ + left];
    bool one = true;
    for (int row = top; row < top + samples_; ++row) {
      const int* parts = &part_[static_cast<size_t>(row) * columns_ + left];
      one = one && std::count(parts, parts + samples_, first) == samples_;
    }
    if (one) return first < 0 ? Floor(whole) : Sample(left + samples_ / 2, top + samples_ / 2);
    Vector3f sum = Vector3f::Zero();
    for (int row = top; row < top + samples_; ++row) {
      for (int column = left; column < left + samples_; ++column) sum += Sample(column, row);
    }
    return sum / static_cast<float>(samples_ * samples_);
  }

  Vector3f Sample(int column, int row) const {
    const size_t at = static_cast<size_t>(row) * columns_ + column;
    const float x = PixelX(column), y = PixelY(row);
    if (part_[at] < 0) return Floor({x, y, 1 / static_cast<float>(samples_)});
    const Vector3f ray = camera_.Ray(x, y);
    const Vector3f point = camera_.eye() + distance_[at] * ray;
    return Body(part_[at], point, SkinNormal(figure_, part_[at], point, normal_[at]), ray);
  }

  Vector3f Body(int index, const Vector3f& point, const Vector3f& normal,
                const Vector3f& ray) const {
    const Vector3f start = point + kShadowBias * normal;
    float lit = 1, open = 1;
    for (const BoundedCone& part : parts_) {
      if (&part == &parts_[index]) continue;
      if (lit > 0 && part.MeetsRay(start, lamp_) &&
          Intersect(part.shape, start, lamp_).distance > 0) {
        lit = 0;
      }
      if (part.HidesSky(start)) open *= 1 - 0.7f * OcclusionBy(part.shape, start, normal);
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

  // Where a ray meets the floor, x and z.
  Eigen::Vector2f OnFloor(const Vector3f& ray) const {
    const float along = -camera_.eye().y() / ray.y();
    return {camera_.eye().x() + along * ray.x(), camera_.eye().z() + along * ray.z()};
  }

  // How much of a stretch of the floor, `width` wide around `at`, the grid's lines cover.
  float Lines(float at, float width) const {
    const float from_line = std::abs(at - grid_ * std::round(at / grid_));
    const float covered = (kGridHalfWidth + 0.5f * width - from_line) / width;
    return std::clamp(covered, 0.0f, std::min(1.0f, 2 * kGridHalfWidth / width));
  }

  // `pixel`: x, y and size.
  Vector3f Floor(const Vector3f& pixel) const {
    const Vector3f ray = camera_.Ray(pixel.x(), pixel.y());
    if (ray.y() > -1e-4f) return background_;
    const Eigen::Vector2f point = OnFloor(ray);
    const float away = (point - Eigen::Vector2f(middle_.x(), middle_.z())).norm();
    if (away > reach_) return background_;
    float shade = floor_light_.At(point.x(), point.y());
    if (grid_ > 0) {
      const Eigen::Vector2f size =
          (OnFloor(camera_.Ray(pixel.x() + pixel.z(), pixel.y())) - point).cwiseAbs() +
          (OnFloor(camera_.Ray(pixel.x(), pixel.y() + pixel.z())) - point).cwiseAbs();
      const float free = (1 - Lines(point.x(), size.x())) * (1 - Lines(point.y(), size.y()));
      shade *= 1 - 0.20f * (1 - free);
    }
    const float fade = SmoothStep(0.55f * reach_, reach_, away);
    return (1 - fade) * shade * floor_ + fade * background_;
  }

  const std::vector<PlacedPart>& figure_;
  std::vector<BoundedCone> parts_;
  std::vector<Vector3f> colours_;
  Camera camera_;
  int samples_;
  Vector3f middle_;
  float reach_;
  Vector3f lamp_;
  FloorLight floor_light_;
  float grid_;
  Vector3f background_, floor_;
  PixelBox box_;
  int columns_ = 0, rows_ = 0;  // of samples, in the box
  std::vector<float> distance_;
  std::vector<int> part_;
  std::vector<Vector3f> normal_;
};

}  // namespace

void DrawFrame(const Skeleton& skeleton, const Pose& pose, const View& view,
               const FrameStyle& style, Picture& picture) {
  if (style.samples < 1 || style.samples > 8) {
    throw InvalidArgument("style.samples", std::to_string(style.samples) + ", must be 1 to 8");
  }
  if (!pose.root_position.allFinite() || !pose.rotations.allFinite()) {
    throw InvalidArgument("pose", "holds values that are not finite");
  }
  const std::vector<PlacedPart> figure = BuildFigure(skeleton, pose);
  Renderer(figure, view, style, picture).Render(picture);
}

}  // namespace choreo
