#include "model/papers/samplers/dense_controls.h"

#include <algorithm>
#include <cmath>

#include "model/core/numbers/smooth_step.h"

namespace choreo {
namespace {

constexpr int kVelocityFrames = 3;  // frames of history that determine the root's velocity
constexpr double kStopFrames =
    8;  // after which a root without a target has lost most of its velocity

Eigen::Vector3d RootVelocity(const std::vector<Pose>& history) {
  const auto back = std::min<size_t>(kVelocityFrames, history.size() - 1);
  if (back == 0) return Eigen::Vector3d::Zero();
  return (history.back().root_position - history[history.size() - 1 - back].root_position) /
         static_cast<double>(back);
}

Eigen::Matrix3Xd SmoothPath(const TransitionSpec& spec) {
  const Eigen::Vector3d from = spec.history.back().root_position;
  const Eigen::Vector3d velocity = RootVelocity(spec.history);
  Eigen::Vector3d end = from;
  Eigen::Array<bool, 3, 1> ends = {false, false, false};
  if (spec.target && spec.target->mask.root_position) {
    end = spec.target->pose.root_position;
    ends.setConstant(true);
  } else if (spec.target && spec.target->height) {
    end.y() = *spec.target->height;
    ends.y() = true;
  }
  const double frames = spec.frames;
  Eigen::Matrix3Xd path(3, spec.frames);
  for (int t = 0; t < spec.frames; ++t) {
    Eigen::Vector3d coast = velocity * kStopFrames * (1 - std::exp(-(t + 1) / kStopFrames));
    coast.y() = 0;
    // A cubic Hermite curve that arrives with the path's mean velocity.
    const double u = (t + 1) / frames, v = 1 - u;
    const Eigen::Vector3d mean = end - from;
    const Eigen::Vector3d way =
        SmoothStep(u) * mean + u * v * v * frames * velocity - u * u * v * mean;
    path.col(t) = from.array() + ends.select(way.array(), coast.array());
  }
  return path;
}

}  // namespace

Controls DenseControls(const TransitionSpec& spec, const ModelInfo& model) {
  Controls dense = spec.controls;
  if (!dense[kRootPath].IsGiven()) dense[kRootPath].values = SmoothPath(spec);
  if (!dense[kVelocityFactors].IsGiven()) {
    const auto& median = model.velocity_references.front().speeds;
    dense[kVelocityFactors].values =
        Eigen::Map<const Eigen::Vector<float, kBodyParts>>(median.data())
            .cast<double>()
            .replicate(1, spec.frames);
  }
  return dense;
}

}  // namespace choreo
