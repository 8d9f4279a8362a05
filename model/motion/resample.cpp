#include "model/motion/resample.h"

#include <algorithm>
#include <cmath>

#include "model/core/error.h"
#include "model/motion/rotation.h"

namespace choreo {

double Duration(const Motion& motion) {
  if (motion.frames.empty()) return 0;
  return static_cast<double>(motion.frames.size() - 1) / motion.fps;
}

int64_t FirstFrameFrom(double seconds, double fps) {
  return static_cast<int64_t>(std::ceil(seconds * fps - kOnFrame));
}

Pose InterpolatePoses(const Pose& a, const Pose& b, double t) {
  Pose pose;
  pose.root_position = a.root_position + t * (b.root_position - a.root_position);
  pose.rotations.resize(3, a.rotations.cols());
  for (Eigen::Index joint = 0; joint < a.rotations.cols(); ++joint) {
    pose.rotations.col(joint) = Slerp(a.rotations.col(joint), b.rotations.col(joint), t);
  }
  return pose;
}

Pose PoseAt(const Motion& motion, double time) {
  if (motion.frames.empty()) throw InvalidArgument("motion.frames", "0 frames, at least 1 needed");
  const auto last = static_cast<double>(motion.frames.size() - 1);
  const double position = std::clamp(time * motion.fps, 0.0, last);
  // Times computed as i / fps must land exactly on frame i.
  const double nearest = std::round(position);
  if (std::abs(position - nearest) < 1e-7) return motion.frames[static_cast<size_t>(nearest)];
  const auto frame = static_cast<size_t>(position);
  return InterpolatePoses(motion.frames[frame], motion.frames[frame + 1],
                          position - static_cast<double>(frame));
}

Motion Resample(const Motion& motion, double fps) {
  if (!(fps >= 1e-3 && fps <= 1e4)) {
    throw InvalidArgument("fps", std::to_string(fps) + ", must be 0.001 to 10000");
  }
  Motion result;
  result.fps = fps;
  if (motion.frames.empty()) return result;
  const auto count = static_cast<size_t>(std::floor(Duration(motion) * fps + kOnFrame)) + 1;
  result.frames.reserve(count);
  for (size_t frame = 0; frame < count; ++frame) {
    result.frames.push_back(PoseAt(motion, static_cast<double>(frame) / fps));
  }
  MakeContinuous(result);
  return result;
}

double WholeRate(double rate) {
  for (const double exact : {std::round(rate), std::round(rate * 1.001) / 1.001}) {
    // "0.0333" is the shortest form of frame times in files.
    if (exact > 0 && std::abs(rate / exact - 1) < 2e-4) return exact;
  }
  return rate;
}

}  // namespace choreo
