#include "model/draw/stage.h"

#include <algorithm>

#include "model/core/error.h"

namespace choreo {
namespace {

constexpr double kMaxExtent = 100;  // metres: the limit of a View
constexpr double kWidening = 1.02;  // ratio of one tried extent to the next
constexpr float kFreeEdge = 0.02f;
constexpr int kTriedHeight = 1000;  // pixels: for any picture

// A wide stage is not a high one.
View StageView(const FramedStage& framed, double extent) {
  View view{.target = {framed.middle.x(), View().target.y(), framed.middle.y()}, .extent = extent};
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
double FitStage(const Stage& stage, const std::vector<FramedStage>& frames, double aspect) {
  const int width = std::max(1, static_cast<int>(kTriedHeight * aspect));
  const Eigen::Array2f size(width, kTriedHeight);
  double extent = 2;
  for (const FramedStage& framed : frames) {
    const std::vector<PlacedPart> figures = FiguresAt(stage, framed.frame);
    const auto fits = [&] {
      const Camera camera(StageView(framed, extent), width, kTriedHeight);
      return std::ranges::all_of(
          figures, [&](const PlacedPart& part) { return IsSeen(part, camera, size); });
    };
    while (extent * kWidening < kMaxExtent && !fits()) extent *= kWidening;
  }
  return extent;
}

// One dancer, three quarters from her front.
std::vector<View> ViewsOfOne(const SkeletonMotion& dancer, const std::vector<FramedStage>& frames,
                             double aspect) {
  std::vector<FramedPose> poses;
  for (const auto& [frame, middle] : frames)
    poses.push_back({&PoseOf(dancer, frame), middle.x(), middle.y()});
  const double azimuth = ThreeQuarterAzimuth(dancer.motion.frames.front());
  const double extent = FitExtent(dancer.skeleton, poses, aspect);
  std::vector<View> views;
  for (const FramedPose& one : poses) views.push_back(StandingView(one, azimuth, extent));
  return views;
}

}  // namespace

void CheckStage(const Stage& stage) {
  if (stage.empty()) throw InvalidArgument("stage", "nobody is on it");
  for (const SkeletonMotion& dancer : stage) {
    if (dancer.motion.frames.empty())
      throw InvalidArgument("motion.frames", "0 frames, at least 1 is needed");
    if (dancer.motion.fps != stage.front().motion.fps)
      throw InvalidArgument("motion.fps", "differs from dancer to dancer");
  }
}

int64_t CountFrames(const Stage& stage) {
  int64_t frames = 0;
  for (const SkeletonMotion& dancer : stage)
    frames = std::max<int64_t>(frames, std::ssize(dancer.motion.frames));
  return frames;
}

const Pose& PoseOf(const SkeletonMotion& dancer, int64_t frame) {
  const int64_t last = std::ssize(dancer.motion.frames) - 1;
  return dancer.motion.frames[static_cast<size_t>(std::clamp<int64_t>(frame, 0, last))];
}

Eigen::Vector2d MiddleOf(const Stage& stage, int64_t frame) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const SkeletonMotion& dancer : stage) {
    const Eigen::Vector3d& root = PoseOf(dancer, frame).root_position;
    sum += Eigen::Vector2d(root.x(), root.z());
  }
  return sum / static_cast<double>(stage.size());
}

std::vector<PlacedPart> FiguresAt(const Stage& stage, int64_t frame) {
  std::vector<PlacedPart> figures;
  for (const SkeletonMotion& dancer : stage) {
    const std::vector<PlacedPart> figure = BuildFigure(dancer.skeleton, PoseOf(dancer, frame));
    figures.insert(figures.end(), figure.begin(), figure.end());
  }
  return figures;
}

std::vector<View> ViewsOf(const Stage& stage, const std::vector<FramedStage>& frames,
                          double aspect) {
  if (stage.size() == 1) return ViewsOfOne(stage.front(), frames, aspect);
  const double extent = FitStage(stage, frames, aspect);
  std::vector<View> views;
  for (const FramedStage& framed : frames) views.push_back(StageView(framed, extent));
  return views;
}

}  // namespace choreo
