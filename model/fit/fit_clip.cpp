#include "model/fit/fit_clip.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "model/core/quantile.h"
#include "model/fit/bone_normaliser.h"
#include "model/fit/fit_problem.h"
#include "model/motion/floor_clearance.h"

namespace choreo {
namespace {

constexpr int kRefinementIterations = 2;

// Over which heights are evened out, seconds. Longer than a jump, shorter than a recording's drift.
constexpr double kGroundWindow = 4.0;
constexpr double kSizeWindow = 1.0;

}  // namespace

double Ground(const Skeleton& skeleton, Motion& motion) {
  std::vector<double> lowest;
  lowest.reserve(motion.frames.size());
  for (const Pose& pose : motion.frames) lowest.push_back(HeightAboveFloor(skeleton, pose));
  const std::vector<double> floor = SlowQuantile(lowest, 0.1, kGroundWindow * motion.fps);
  for (size_t frame = 0; frame < floor.size(); ++frame) {
    motion.frames[frame].root_position.y() -= floor[frame];
  }
  return -std::accumulate(floor.begin(), floor.end(), 0.0) / static_cast<double>(floor.size());
}

FitResult FitClip(const PositionClip& clip, const SourceMapping& mapping, const Skeleton& skeleton,
                  const FitOptions& options) {
  ValidateClip(clip);
  const BoneNormaliser normaliser(skeleton, mapping, clip.joint_names);
  SourceSize size = normaliser.Measure(clip);
  const size_t count = clip.frames.size();
  FitResult result;
  Motion& motion = result.motion;
  motion.fps = clip.fps;
  motion.frames.reserve(count);
  std::vector<double> height_scales;
  height_scales.reserve(count);
  for (const Eigen::Matrix3Xd& frame : clip.frames)
    height_scales.push_back(normaliser.HeightScale(frame));
  height_scales = SlowQuantile(height_scales, 0.5, kSizeWindow * clip.fps);
  std::vector<Eigen::Matrix3Xd> targets(count);
  PositionFitter fitter(skeleton, mapping, options, clip.fps);
  for (size_t frame = 0; frame < count; ++frame) {
    size.height_scale = height_scales[frame];
    normaliser.Apply(clip.frames[frame], size, targets[frame]);
    motion.frames.push_back(fitter.Next(targets[frame]));
  }
  // Once more with the frame behind known too, so that nothing lags.
  FitProblem problem(skeleton, mapping, options, clip.fps);
  std::vector<double> distances;
  distances.reserve(count * normaliser.landmarks());
  for (size_t frame = 0; frame < count; ++frame) {
    const FitNeighbours neighbours = {
        .before = frame > 0 ? &motion.frames[frame - 1] : nullptr,
        .after = frame + 1 < count ? &motion.frames[frame + 1] : nullptr};
    problem.Solve(targets[frame], neighbours, kRefinementIterations, motion.frames[frame]);
    if (frame > 0) MakeContinuous(motion.frames[frame], motion.frames[frame - 1]);
    for (int i = 0; i < normaliser.landmarks(); ++i)
      distances.push_back((problem.landmarks().col(i) - targets[frame].col(i)).norm());
  }
  FitReport& report = result.report;
  for (const double distance : distances)
    report.mean_error_m += distance / static_cast<double>(distances.size());
  report.p95_error_m = Quantile(std::move(distances), 0.95);
  report.scale = size.scale;
  if (options.ground) report.ground_shift_m = Ground(skeleton, motion);
  return result;
}

}  // namespace choreo
