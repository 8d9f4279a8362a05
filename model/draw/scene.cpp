#include "model/draw/scene.h"

#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/core/numbers/gaussian_mean.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kMaxExtent = 100;  // metres: the limit of a View
constexpr double kWidening = 1.02;  // ratio of one tried extent to the next
constexpr float kFreeEdge = 0.02f;
constexpr int kTriedHeight = 1000;  // pixels: serves pictures of any size

double AzimuthOf(CameraSide side) {
  switch (side) {
    case CameraSide::kFront:
      return 0;
    case CameraSide::kSide:
      return M_PI / 2;
    case CameraSide::kBack:
      return M_PI;
    default:
      return kThreeQuarters;
  }
}

// The dancer's heading in each frame, low-passed, without jumps from turn to turn.
std::vector<double> SmoothHeadings(const Motion& motion) {
  std::vector<double> headings;
  for (const Pose& pose : motion.frames) {
    const double last = headings.empty() ? 0 : headings.back();
    headings.push_back(last + WrapAngle(Heading(ExpMap(pose.rotations.col(0))) - last));
  }
  const double sigma = kCameraLag * motion.fps;
  const auto reach = static_cast<int64_t>(std::ceil(3 * sigma));
  const int64_t end = std::ssize(headings) - 1;
  std::vector<double> smooth;
  for (int64_t frame = 0; frame <= end; ++frame) {
    smooth.push_back(
        GaussianMean(frame - reach, frame + reach, frame, sigma, 0.0, [&](int64_t near) {
          return headings[static_cast<size_t>(std::clamp<int64_t>(near, 0, end))];
        }));
  }
  return smooth;
}

// A View of a scene, which may be wide without being high.
View SceneView(const FramedScene& framed, double azimuth, double extent) {
  View view{.target = {framed.middle.x(), View().target.y(), framed.middle.y()},
            .azimuth = azimuth,
            .extent = extent};
  view.target.y() = std::min(view.target.y(), StandingView({}, 0, extent).target.y());
  return view;
}

bool IsSeen(const PlacedPart& part, const Camera& camera, const Eigen::Array2f& size) {
  for (const auto& [ball, radius] : {std::pair(part.shape.a, part.shape.radius_a),
                                     std::pair(part.shape.b, part.shape.radius_b)}) {
    const Eigen::AlignedBox2f box = camera.Bounds(ball, radius);
    if ((box.min().array() < kFreeEdge * size).any() ||
        (box.max().array() > (1 - kFreeEdge) * size).any()) {
      return false;
    }
  }
  return true;
}

// The least extent that shows everybody; nearer dancers look larger.
double FitScene(const Scene& scene, const std::vector<FramedScene>& frames, double azimuth,
                double aspect) {
  const int width = std::max(1, static_cast<int>(kTriedHeight * aspect));
  const Eigen::Array2f size(width, kTriedHeight);
  double extent = 2;
  for (const FramedScene& framed : frames) {
    const std::vector<PlacedPart> dolls = DollsAt(scene, framed.frame);
    const auto fits = [&] {
      const Camera camera(SceneView(framed, azimuth, extent), width, kTriedHeight);
      return std::ranges::all_of(
          dolls, [&](const PlacedPart& part) { return IsSeen(part, camera, size); });
    };
    while (extent * kWidening < kMaxExtent && !fits()) extent *= kWidening;
  }
  return extent;
}

std::vector<View> ViewsOfOne(const SkeletonMotion& dancer, const std::vector<FramedScene>& frames,
                             double aspect, CameraSide side) {
  std::vector<FramedPose> poses;
  for (const auto& [frame, middle] : frames)
    poses.push_back({&PoseOf(dancer, frame), middle.x(), middle.y()});
  std::vector<double> headings = {Heading(ExpMap(dancer.motion.frames.front().rotations.col(0)))};
  if (side == CameraSide::kFollow) headings = SmoothHeadings(dancer.motion);
  const double extent = FitExtent(dancer.skeleton, poses, aspect);
  std::vector<View> views;
  for (size_t i = 0; i < poses.size(); ++i) {
    const auto known = std::min<int64_t>(frames[i].frame, std::ssize(headings) - 1);
    const double azimuth = WrapAngle(headings[static_cast<size_t>(known)] + AzimuthOf(side));
    views.push_back(StandingView(poses[i], azimuth, extent));
  }
  return views;
}

}  // namespace

CameraSide FindCamera(const std::string& name) {
  const auto found = std::ranges::find(kCameraNames, name);
  if (found != kCameraNames.end()) return static_cast<CameraSide>(found - kCameraNames.begin());
  throw InvalidArgument("camera",
                        '"' + name + "\" is none of " +
                            Joined(kCameraNames, [](const char* known) { return known; }));
}

void CheckScene(const Scene& scene) {
  if (scene.empty()) throw InvalidArgument("stage", "nobody is on it");
  for (const SkeletonMotion& dancer : scene) {
    if (dancer.motion.frames.empty())
      throw InvalidArgument("motion.frames", "0 frames, at least 1 is needed");
    if (dancer.motion.fps != scene.front().motion.fps)
      throw InvalidArgument("motion.fps", "differs from dancer to dancer");
  }
}

int64_t CountFrames(const Scene& scene) {
  int64_t frames = 0;
  for (const SkeletonMotion& dancer : scene)
    frames = std::max<int64_t>(frames, std::ssize(dancer.motion.frames));
  return frames;
}

const Pose& PoseOf(const SkeletonMotion& dancer, int64_t frame) {
  const int64_t last = std::ssize(dancer.motion.frames) - 1;
  return dancer.motion.frames[static_cast<size_t>(std::clamp<int64_t>(frame, 0, last))];
}

Eigen::Vector2d MiddleOf(const Scene& scene, int64_t frame) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const SkeletonMotion& dancer : scene) {
    const Eigen::Vector3d& root = PoseOf(dancer, frame).root_position;
    sum += Eigen::Vector2d(root.x(), root.z());
  }
  return sum / static_cast<double>(scene.size());
}

std::vector<PlacedPart> DollsAt(const Scene& scene, int64_t frame) {
  std::vector<PlacedPart> dolls;
  for (const SkeletonMotion& dancer : scene) {
    const std::vector<PlacedPart> doll = BuildDoll(dancer.skeleton, PoseOf(dancer, frame));
    dolls.insert(dolls.end(), doll.begin(), doll.end());
  }
  return dolls;
}

std::vector<View> ViewsOf(const Scene& scene, const std::vector<FramedScene>& frames, double aspect,
                          std::optional<CameraSide> side) {
  if (scene.size() == 1)
    return ViewsOfOne(scene.front(), frames, aspect, side.value_or(CameraSide::kThreeQuarter));
  if (side == CameraSide::kFollow) {
    throw InvalidArgument(
        "camera", "follow turns with one dancer, and there are " + std::to_string(scene.size()));
  }
  const double azimuth = AzimuthOf(side.value_or(CameraSide::kFront));
  const double extent = FitScene(scene, frames, azimuth, aspect);
  std::vector<View> views;
  for (const FramedScene& framed : frames) views.push_back(SceneView(framed, azimuth, extent));
  return views;
}

}  // namespace choreo
