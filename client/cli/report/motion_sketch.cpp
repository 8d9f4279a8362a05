#include "client/cli/report/motion_sketch.h"

#include <algorithm>
#include <cmath>

#include "model/motion/resample.h"
#include "model/motion/rotation.h"

namespace choreo::cli {
namespace {

constexpr int64_t kMoments = 16;
constexpr double kAlike = 0.1;  // radians; more than the error of interpolating between frames
constexpr double kGoldenAngle = 2.4;  // radians

// Sums angles with weights spread over [-1, 1], so that changes of joints do not cancel.
double AngleSum(const Pose& pose) {
  double sum = 0;
  for (Eigen::Index joint = 1; joint < pose.rotations.cols(); ++joint) {
    const double angle = LogMap(ExpMap(pose.rotations.col(joint))).norm();
    sum += std::cos(kGoldenAngle * static_cast<double>(joint)) * angle;
  }
  return sum;
}

}  // namespace

MotionSketch SketchOf(const Motion& motion, int64_t frames, double fps) {
  MotionSketch sketch;
  const int64_t moments = motion.frames.empty() ? 0 : std::min(kMoments, frames);
  for (int64_t i = 0; i < moments; ++i) {
    const int64_t frame = i * (frames - 1) / std::max<int64_t>(1, moments - 1);
    const double seconds = std::min(static_cast<double>(frame) / fps, Duration(motion));
    sketch.push_back(std::round(1e3 * AngleSum(PoseAt(motion, seconds))) / 1e3);
  }
  return sketch;
}

size_t CountUnlike(const MotionSketch& a, const MotionSketch& b) {
  size_t unlike = std::max(a.size(), b.size()) - std::min(a.size(), b.size());
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    unlike += std::abs(a[i] - b[i]) > kAlike;
  return unlike;
}

}  // namespace choreo::cli
