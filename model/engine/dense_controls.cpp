#include "model/engine/dense_controls.h"

#include <algorithm>
#include <cmath>

namespace choreo {
namespace {

constexpr int kVelocityFrames = 3;  // of history, over which the root's velocity is taken
constexpr double kStopFrames = 8;   // in which a root without a target loses most of its velocity
constexpr int kStartFrames = 20;    // over which a path that starts elsewhere is reached
constexpr int kEndFrames = 30;      // over which one that ends elsewhere is left

double SmoothStep(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

Eigen::Vector3d RootVelocity(const std::vector<Pose>& history) {
  const auto back = std::min<size_t>(kVelocityFrames, history.size() - 1);
  if (back == 0) return Eigen::Vector3d::Zero();
  return (history.back().root_position - history[history.size() - 1 - back].root_position) /
         static_cast<double>(back);
}

Eigen::Matrix3Xd SmoothPath(const TransitionSpec& spec, const Eigen::Vector3d* end) {
  const Eigen::Vector3d from = spec.history.back().root_position;
  const Eigen::Vector3d velocity = RootVelocity(spec.history);
  const double frames = spec.frames;
  Eigen::Matrix3Xd path(3, spec.frames);
  for (int t = 0; t < spec.frames; ++t) {
    if (end == nullptr) {
      Eigen::Vector3d coast = velocity * kStopFrames * (1 - std::exp(-(t + 1) / kStopFrames));
      coast.y() = 0;
      path.col(t) = from + coast;
      continue;
    }
    // Cubic Hermite; it arrives with the mean velocity of the whole way.
    const double u = (t + 1) / frames, v = 1 - u;
    const Eigen::Vector3d mean = *end - from;
    path.col(t) =
        from + u * u * (3 - 2 * u) * mean + u * v * v * frames * velocity - u * u * v * mean;
  }
  return path;
}

}  // namespace

Controls DenseControls(const TransitionSpec& spec, const ModelInfo& model) {
  const int frames = spec.frames;
  const bool ends = spec.target && spec.target->mask.root_position;
  const Eigen::Vector3d* end = ends ? &spec.target->pose.root_position : nullptr;
  Eigen::Matrix3Xd path;
  if (spec.controls.root_path.cols() == 0) {
    path = SmoothPath(spec, end);
  } else {
    path = spec.controls.root_path.cast<double>();
    const Eigen::Vector3d step =
        frames > 1 ? (path.col(1) - path.col(0)).eval() : Eigen::Vector3d::Zero().eval();
    const Eigen::Vector3d start = spec.history.back().root_position - (path.col(0) - step);
    for (int t = 0; t < frames; ++t)
      path.col(t) += (1 - SmoothStep((t + 1.0) / std::min(frames, kStartFrames))) * start;
    if (end != nullptr) {
      const Eigen::Vector3d miss = *end - path.col(frames - 1);
      const int over = std::min(frames, kEndFrames);
      for (int t = frames - over; t < frames; ++t)
        path.col(t) += SmoothStep((t + 1.0 - (frames - over)) / over) * miss;
    }
  }
  Controls dense;
  dense.root_path = path.cast<float>();
  dense.velocity_factors = spec.controls.velocity_factors;
  if (dense.velocity_factors.cols() == 0) {
    const auto& median = model.velocity_references.front().factors;
    dense.velocity_factors.resize(kBodyParts, frames);
    for (int part = 0; part < kBodyParts; ++part)
      dense.velocity_factors.row(part).setConstant(median[static_cast<size_t>(part)]);
  }
  return dense;
}

}  // namespace choreo
