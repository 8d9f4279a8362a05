#include "model/motion/fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "model/core/error.h"
#include "model/motion/fit_solver.h"
#include "model/motion/kinematics.h"

namespace choreo {
namespace {

// Root mean square distance of the landmarks at which a warm start is taken for lost.
constexpr double kLostDistance = 0.04;
// Radians that no trunk turns. One that does is wound up: hips and shoulders are where they belong,
// a whole turn apart.
constexpr double kWoundTurn = 2.6;
constexpr int kRefinementIterations = 2;

// Over which heights are evened out, seconds. Longer than a jump, shorter than a recording's drift.
constexpr double kGroundWindow = 4.0;
constexpr double kSizeWindow = 1.0;
constexpr double kBodyClearance = 0.05;

double Quantile(std::vector<double> values, double q) {
  const auto index = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[index];
}

// A running quantile, and its running mean: what a signal does slowly.
std::vector<double> SlowQuantile(const std::vector<double>& values, double q,
                                 double window_frames) {
  const auto count = static_cast<int>(values.size());
  const int half = std::max(1, static_cast<int>(std::lround(0.5 * window_frames)));
  std::vector<double> quantiles(count), means(count);
  const auto window = [&](int frame) {
    return std::pair(std::max(0, frame - half), std::min(count, frame + half + 1));
  };
  for (int frame = 0; frame < count; ++frame) {
    const auto [first, last] = window(frame);
    quantiles[frame] = Quantile({values.begin() + first, values.begin() + last}, q);
  }
  for (int frame = 0; frame < count; ++frame) {
    const auto [first, last] = window(frame);
    means[frame] =
        std::accumulate(quantiles.begin() + first, quantiles.begin() + last, 0.0) / (last - first);
  }
  return means;
}

}  // namespace

Eigen::RowVectorXd FloorClearance(const Skeleton& skeleton) {
  const Eigen::RowVectorXd rest = JointPositions(skeleton, RestPose(skeleton)).row(1);
  // Some skeletons have more of the foot than its role names, such as heels.
  Eigen::RowVectorXd clearance = rest.cwiseMin(kBodyClearance);
  for (const int foot : skeleton.feet) {
    if (foot >= 0) clearance[foot] = rest[foot];
  }
  return clearance;
}

double HeightAboveFloor(const Skeleton& skeleton, const Pose& pose) {
  return (JointPositions(skeleton, pose).row(1) - FloorClearance(skeleton)).minCoeff();
}

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

class PositionFitter::Solver {
 public:
  Solver(const Skeleton& skeleton, const SourceMapping& mapping, const FitOptions& options,
         double fps)
      : problem_(skeleton, mapping, options, fps), options_(options) {}

  const Pose& Next(const Eigen::Matrix3Xd& targets, const Pose* after) {
    if (targets.cols() != problem_.landmarks_count() || !targets.allFinite()) {
      throw InvalidArgument("targets", std::to_string(targets.cols()) + " landmarks, must be " +
                                           std::to_string(problem_.landmarks_count()) +
                                           " and finite");
    }
    if (!has_previous_) {
      problem_.Initialise(targets, pose_);
      problem_.Solve(targets, {}, options_.first_iterations, pose_);
    } else {
      previous_ = pose_;
      const FitProblem::Neighbours neighbours = {.before = &previous_, .after = after};
      const double distance = problem_.Solve(targets, neighbours, options_.iterations, pose_);
      if (options_.recover &&
          (distance > kLostDistance || problem_.TrunkTurn(pose_) > kWoundTurn)) {
        Recover(targets, neighbours, distance);
      }
      MakeContinuous(pose_, previous_);
    }
    has_previous_ = true;
    return pose_;
  }

  FitProblem problem_;
  FitOptions options_;
  Pose pose_, previous_, fresh_;
  bool has_previous_ = false;

 private:
  // Tries again from scratch, and keeps that only where it is much nearer, or as near and unwound:
  // a clip that does not fit at all should at least be smooth.
  void Recover(const Eigen::Matrix3Xd& targets, const FitProblem::Neighbours& neighbours,
               double distance) {
    problem_.Initialise(targets, fresh_);
    const double again = problem_.Solve(targets, {}, options_.first_iterations, fresh_);
    const bool unwound = problem_.TrunkTurn(pose_) > kWoundTurn &&
                         problem_.TrunkTurn(fresh_) < kWoundTurn &&
                         again < std::max(distance, kLostDistance);
    if (again < 0.5 * distance || unwound) {
      std::swap(pose_, fresh_);
    } else {
      problem_.Solve(targets, neighbours, options_.iterations, pose_);
    }
  }
};

PositionFitter::PositionFitter(const Skeleton& skeleton, const SourceMapping& mapping,
                               const FitOptions& options, double fps)
    : solver_(std::make_unique<Solver>(skeleton, mapping, options, fps)) {}
PositionFitter::~PositionFitter() = default;
PositionFitter::PositionFitter(PositionFitter&&) noexcept = default;
PositionFitter& PositionFitter::operator=(PositionFitter&&) noexcept = default;

const Pose& PositionFitter::Next(const Eigen::Matrix3Xd& targets, const Pose* after) {
  return solver_->Next(targets, after);
}

const Eigen::Matrix3Xd& PositionFitter::landmarks() const { return solver_->problem_.landmarks(); }

void PositionFitter::Reset() { solver_->has_previous_ = false; }

void PositionFitter::Reset(const Pose& previous) {
  solver_->pose_ = previous;
  solver_->has_previous_ = true;
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
  result.report.landmark_error_m.assign(normaliser.landmarks(), 0.0);
  for (size_t frame = 0; frame < count; ++frame) {
    const FitProblem::Neighbours neighbours = {
        .before = frame > 0 ? &motion.frames[frame - 1] : nullptr,
        .after = frame + 1 < count ? &motion.frames[frame + 1] : nullptr};
    problem.Solve(targets[frame], neighbours, kRefinementIterations, motion.frames[frame]);
    if (frame > 0) MakeContinuous(motion.frames[frame], motion.frames[frame - 1]);
    for (int i = 0; i < normaliser.landmarks(); ++i) {
      const double distance = (problem.landmarks().col(i) - targets[frame].col(i)).norm();
      distances.push_back(distance);
      result.report.landmark_error_m[i] += distance / static_cast<double>(count);
    }
  }
  FitReport& report = result.report;
  for (const Landmark& landmark : mapping.landmarks) report.landmark_names.push_back(landmark.name);
  for (const double distance : distances) {
    report.mean_error_m += distance / static_cast<double>(distances.size());
    report.max_error_m = std::max(report.max_error_m, distance);
  }
  report.p95_error_m = Quantile(std::move(distances), 0.95);
  report.scale = size.scale;
  if (options.ground) report.ground_shift_m = Ground(skeleton, motion);
  return result;
}

}  // namespace choreo
