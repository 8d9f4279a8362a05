#include "model/fit/solver/fit_clip.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "model/core/numbers/quantile.h"
#include "model/fit/solver/bone_normaliser.h"
#include "model/motion/floor/floor_clearance.h"

namespace choreo {
namespace {

constexpr int kRefinementIterations = 2;

// Window over which heights are levelled, seconds: longer than a jump, shorter than a recording's
// drift.
constexpr double kGroundWindow = 4.0;
// The quantile of the lowest joint's heights in that window that is taken as the floor. Jumping
// dancers are on the floor for longer than this share; feet that the recording sinks into the floor
// are there for less.
constexpr double kGroundShare = 0.3;
constexpr double kSizeWindow = 1.0;

}  // namespace

double Ground(const Skeleton& skeleton, Motion& motion) {
  std::vector<double> lowest;
  for (const Pose& pose : motion.frames) lowest.push_back(HeightAboveFloor(skeleton, pose));
  const std::vector<double> floor = SlowQuantile(lowest, kGroundShare, kGroundWindow * motion.fps);
  for (size_t frame = 0; frame < floor.size(); ++frame) {
    motion.frames[frame].root_position.y() -= floor[frame];
  }
  return -std::accumulate(floor.begin(), floor.end(), 0.0) / static_cast<double>(floor.size());
}

FitResult FitClip(const PositionClip& clip, const SourceMapping& mapping, const Skeleton& skeleton,
                  const FitOptions& options) {
  CheckClip(clip);
  const BoneNormaliser normaliser(skeleton, mapping, clip.joint_names);
  const SourceSize size = normaliser.Measure(clip);
  const size_t count = clip.frames.size();
  FitResult result;
  Motion& motion = result.motion;
  motion.fps = clip.fps;
  std::vector<double> height_scales;
  for (const Eigen::Matrix3Xd& frame : clip.frames)
    height_scales.push_back(normaliser.HeightScale(frame));
  height_scales = SlowQuantile(height_scales, 0.5, kSizeWindow * clip.fps);
  std::vector<Eigen::Matrix3Xd> targets;
  PositionFitter fitter(skeleton, mapping, options, clip.fps);
  for (size_t frame = 0; frame < count; ++frame) {
    targets.push_back(normaliser.Apply(clip.frames[frame], size, height_scales[frame]));
    motion.frames.push_back(fitter.Next(targets.back()));
  }
  // Refines with the next frame also known, so that nothing lags.
  FitProblem problem(skeleton, mapping, options, clip.fps);
  std::vector<double> distances;
  for (size_t frame = 0; frame < count; ++frame) {
    const FitNeighbours neighbours = {
        .before = frame > 0 ? &motion.frames[frame - 1] : nullptr,
        .after = frame + 1 < count ? &motion.frames[frame + 1] : nullptr};
    problem.Solve(targets[frame], neighbours, kRefinementIterations, motion.frames[frame]);
    if (frame > 0) MakeContinuous(motion.frames[frame], motion.frames[frame - 1]);
    for (Eigen::Index i = 0; i < targets[frame].cols(); ++i)
      distances.push_back((problem.landmarks().col(i) - targets[frame].col(i)).norm());
  }
  for (const double distance : distances)
    result.mean_error_m += distance / static_cast<double>(distances.size());
  result.p95_error_m = Quantile(std::move(distances), 0.95);
  result.scale = size.scale;
  if (options.ground) result.ground_shift_m = Ground(skeleton, motion);
  return result;
}

}  // namespace choreo
