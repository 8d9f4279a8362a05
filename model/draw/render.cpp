#include "model/draw/render.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/core/error.h"
#include "model/draw/figure.h"

namespace choreo {
namespace {

using Eigen::Vector3f;

constexpr float kLampSpread = 0.10f;      // radians
constexpr float kShadowCell = 0.025f;     // metres
constexpr float kShadowBias = 0.012f;     // metres off the surface: parts overlap at the joints
constexpr float kBlend = 0.012f;          // metres
constexpr float kGridHalfWidth = 0.008f;  // metres

Vector3f Linear(const Colour& colour) {
  const auto linear = [](double value) { return static_cast<float>(std::pow(value, 2.2)); };
  return {linear(colour.r), linear(colour.g), linear(colour.b)};
}

uint8_t Encode(float linear) {
  const float value = std::pow(std::clamp(linear, 0.0f, 1.0f), 1 / 2.2f);
  return static_cast<uint8_t>(std::lround(255 * value));
}

float SmoothStep(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Light that reaches the floor around a dancer, on a grid: most of what a floor pixel costs.
class FloorLight {
 public:
  FloorLight(const std::vector<BodyPart>& parts, const Vector3f& middle, float reach,
             const Vector3f& lamp)
      : side_(2 + static_cast<int>(std::ceil(2 * reach / kShadowCell))),
        low_x_(middle.x() - reach),
        low_z_(middle.z() - reach),
        lamp_(static_cast<size_t>(side_) * side_),
        sky_(lamp_.size()) {
    for (int row = 0; row < side_; ++row) {
      for (int column = 0; column < side_; ++column) {
        const Vector3f point(low_x_ + static_cast<float>(column) * kShadowCell, 0,
                             low_z_ + static_cast<float>(row) * kShadowCell);
        float hidden = 0, open = 1;
        for (const BodyPart& part : parts) {
          hidden = std::max(hidden, ShadowOf(part.shape, point, lamp, kLampSpread));
          open *= 1 - OcclusionBy(part.shape, point, Vector3f::UnitY());
        }
        const size_t index = static_cast<size_t>(row) * side_ + column;
        lamp_[index] = 1 - hidden;
        sky_[index] = open;
      }
    }
  }

  // Of the full light, 0 to 1.
  float At(float x, float z) const {
    const auto last = static_cast<float>(side_ - 1) - 1e-3f;
    const float u = std::clamp((x - low_x_) / kShadowCell, 0.0f, last);
    const float v = std::clamp((z - low_z_) / kShadowCell, 0.0f, last);
    const auto column = static_cast<int>(u), row = static_cast<int>(v);
    const float s = u - static_cast<float>(column), t = v - static_cast<float>(row);
    const auto value = [&](int r, int c) {
      const size_t index = static_cast<size_t>(r) * side_ + c;
      return 0.45f * lamp_[index] + 0.55f * sky_[index];
    };
    return (1 - t) * ((1 - s) * value(row, column) + s * value(row, column + 1)) +
           t * ((1 - s) * value(row + 1, column) + s * value(row + 1, column + 1));
  }

 private:
  int side_;
  float low_x_, low_z_;
  std::vector<float> lamp_, sky_;
};

class Renderer {
 public:
  Renderer(std::vector<BodyPart> parts, const View& view, const FrameStyle& style,
           const Picture& picture)
      : parts_(std::move(parts)),
        camera_(view, picture.width, picture.height),
        samples_(style.samples),
        columns_(picture.width * style.samples),
        rows_(picture.height * style.samples),
        middle_(view.target.cast<float>()),
        reach_(static_cast<float>(0.72 * view.extent *
                                  std::max(1.0, double{1} * picture.width / picture.height))),
        lamp_(LampDirection(view.azimuth)),
        floor_light_(parts_, middle_, reach_, lamp_),
        grid_(static_cast<float>(style.grid_m)),
        background_(Linear(style.background)),
        floor_(Linear(style.floor)),
        distance_(static_cast<size_t>(columns_) * rows_, -1.0f),
        part_(distance_.size(), -1),
        normal_(distance_.size()) {
    for (const BodyPart& part : parts_) colours_.push_back(Linear(part.colour));
  }

  void Render(Picture& picture) {
    for (size_t i = 0; i < parts_.size(); ++i) Cast(static_cast<int>(i));
    picture.rgb.resize(size_t{3} * picture.width * picture.height);
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        Vector3f sum = Vector3f::Zero();
        for (int row = y * samples_; row < (y + 1) * samples_; ++row) {
          for (int column = x * samples_; column < (x + 1) * samples_; ++column) {
            sum += Sample(column, row);
          }
        }
        sum /= static_cast<float>(samples_ * samples_);
        for (int c = 0; c < 3; ++c) {
          picture.rgb[3 * (static_cast<size_t>(y) * picture.width + x) + c] = Encode(sum[c]);
        }
      }
    }
  }

 private:
  // From the left above the camera.
  static Vector3f LampDirection(double azimuth) {
    const double side = azimuth - 0.75;
    return Eigen::Vector3d(0.62 * std::sin(side), 1, 0.62 * std::cos(side))
        .normalized()
        .cast<float>();
  }

  Vector3f Ray(int column, int row) const {
    return camera_.Ray((static_cast<float>(column) + 0.5f) / static_cast<float>(samples_),
                       (static_cast<float>(row) + 0.5f) / static_cast<float>(samples_));
  }

  // Enters one part's nearest points.
  void Cast(int index) {
    const RoundedCone& shape = parts_[index].shape;
    const Camera::Box a = camera_.Bounds(shape.a, shape.radius_a);
    const Camera::Box b = camera_.Bounds(shape.b, shape.radius_b);
    const auto scale = static_cast<float>(samples_);
    const int left = static_cast<int>(std::min(a.left, b.left) * scale);
    const int top = static_cast<int>(std::min(a.top, b.top) * scale);
    const int right = std::min(columns_, 1 + static_cast<int>(std::max(a.right, b.right) * scale));
    const int bottom = std::min(rows_, 1 + static_cast<int>(std::max(a.bottom, b.bottom) * scale));
    for (int row = top; row < bottom; ++row) {
      for (int column = left; column < right; ++column) {
        const RayHit hit = Intersect(shape, camera_.eye(), Ray(column, row));
        const size_t at = static_cast<size_t>(row) * columns_ + column;
        if (hit.distance < 0 || (part_[at] >= 0 && distance_[at] <= hit.distance)) continue;
        distance_[at] = hit.distance;
        part_[at] = index;
        normal_[at] = hit.normal;
      }
    }
  }

  Vector3f Sample(int column, int row) const {
    const size_t at = static_cast<size_t>(row) * columns_ + column;
    const Vector3f ray = Ray(column, row);
    if (part_[at] >= 0) {
      const Vector3f point = camera_.eye() + distance_[at] * ray;
      return Body(part_[at], point, SkinNormal(part_[at], point, normal_[at]), ray);
    }
    return Floor(ray);
  }

  // Parts of one colour are one piece of skin: where they meet, their normals are blended.
  Vector3f SkinNormal(int index, const Vector3f& point, const Vector3f& own) const {
    Vector3f sum = own;
    for (size_t i = 0; i < parts_.size(); ++i) {
      if (static_cast<int>(i) == index || colours_[i] != colours_[index]) continue;
      Vector3f normal;
      const float distance = SurfaceDistance(parts_[i].shape, point, normal);
      if (distance < 4 * kBlend) sum += std::exp(-std::max(0.0f, distance) / kBlend) * normal;
    }
    return sum.normalized();
  }

  Vector3f Body(int index, const Vector3f& point, const Vector3f& normal,
                const Vector3f& ray) const {
    const Vector3f start = point + kShadowBias * normal;
    float lit = 1, open = 1;
    for (const BodyPart& part : parts_) {
      if (&part == &parts_[index]) continue;
      if (lit > 0 && Intersect(part.shape, start, lamp_).distance > 0) lit = 0;
      open *= 1 - 0.7f * OcclusionBy(part.shape, start, normal);
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

  Vector3f Floor(const Vector3f& ray) const {
    if (ray.y() > -1e-4f) return background_;
    const Vector3f point = camera_.eye() - camera_.eye().y() / ray.y() * ray;
    const float away = (point - Vector3f(middle_.x(), 0, middle_.z())).norm();
    if (away > reach_) return background_;
    float shade = floor_light_.At(point.x(), point.z());
    if (grid_ > 0) {
      const auto from_line = [&](float value) {
        return std::abs(value - grid_ * std::round(value / grid_));
      };
      const float line = std::min(from_line(point.x()), from_line(point.z()));
      if (line < kGridHalfWidth) shade *= 0.80f;
    }
    const float fade = SmoothStep(0.55f * reach_, reach_, away);
    return (1 - fade) * shade * floor_ + fade * background_;
  }

  std::vector<BodyPart> parts_;
  std::vector<Vector3f> colours_;
  Camera camera_;
  int samples_, columns_, rows_;
  Vector3f middle_;
  float reach_;
  Vector3f lamp_;
  FloorLight floor_light_;
  float grid_;
  Vector3f background_, floor_;
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
  Renderer(BuildFigure(skeleton, pose), view, style, picture).Render(picture);
}

}  // namespace choreo
