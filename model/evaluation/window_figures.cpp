#include "model/evaluation/window_figures.h"

#include <algorithm>

#include "model/dance/quality_report.h"
#include "model/metrics/foot_contact_score.h"
#include "model/metrics/frechet.h"
#include "model/metrics/linear.h"
#include "model/metrics/motion_features.h"
#include "model/metrics/pose_distance.h"
#include "model/motion/kinematics.h"

namespace choreo {
WindowFigures MeasureWindow(const Skeleton& skeleton, double fps, const std::vector<Pose>& danced,
                            const std::vector<Pose>& real) {
  WindowFigures figures;
  const QualityReport quality = MeasureMotion(skeleton, {.fps = fps, .frames = danced});
  figures.skate_ratio = quality.skate_ratio;
  figures.p95_acceleration = quality.p95_acceleration;
  figures.max_acceleration = quality.max_acceleration;
  const std::span<const Pose> ours = std::span(danced).subspan(kFramesBefore);
  const std::span<const Pose> theirs = std::span(real).subspan(kFramesBefore);
  const JointTrack track = TrackJoints(skeleton, ours), truth = TrackJoints(skeleton, theirs);
  figures.l2p = L2P(track, truth);
  figures.raw_key_distance = figures.key_distance = KeyPoseDistance(track.back(), truth.back());
  const PoseError error = ComparePoses(skeleton, ours.back(), theirs.back());
  figures.raw_key_m = figures.final_key_m = error.position_m;
  figures.final_key_deg = error.angle_deg;
  const Eigen::MatrixXd turns = GlobalQuaternions(skeleton, ours);
  const Eigen::MatrixXd real_turns = GlobalQuaternions(skeleton, theirs);
  figures.l2q = L2Q(turns, real_turns);
  const Npss npss = MeasureNpss(turns, real_turns);
  figures.npss_sum = npss.sum;
  figures.npss_weight = npss.weight;
  figures.pfc = PhysicalFootContact(skeleton, track);
  figures.pace.Add(track, fps);
  if (track.size() >= 3) figures.kinetic = KineticFeatures(track, fps);
  if (track.size() >= 2 && HasGeometricFeatures(skeleton))
    figures.geometric = GeometricFeatures(skeleton, track, fps);
  return figures;
}

double Largest(const std::vector<WindowFigures>& windows, double WindowFigures::*figure) {
  double largest = 0;
  for (const WindowFigures& window : windows) largest = std::max(largest, window.*figure);
  return largest;
}

RealFeatures GatherRealFeatures(const ClipSet& set, int frames) {
  std::vector<Eigen::VectorXd> kinetic, geometric;
  const auto length = static_cast<size_t>(frames);
  for (const PreparedClip& clip : set.clips) {
    const JointTrack track = TrackJoints(clip.skeleton, clip.motion.frames);
    for (size_t start = 0; start + length <= track.size();
         start += std::max<size_t>(1, length / 2)) {
      const auto first = track.begin() + start;
      const JointTrack part(first, first + frames);
      if (frames >= 3) kinetic.push_back(KineticFeatures(part, clip.motion.fps));
      if (frames >= 2 && HasGeometricFeatures(clip.skeleton))
        geometric.push_back(GeometricFeatures(clip.skeleton, part, clip.motion.fps));
    }
  }
  return {SideBySide(kinetic), SideBySide(geometric)};
}

FeatureFigures CompareFeatures(const Eigen::MatrixXd& real, const Eigen::MatrixXd& others) {
  if (others.cols() < 2 || real.cols() < 2) return {};
  const FeatureScale scale = FeatureScale::Of(real);
  const Eigen::MatrixXd scaled = scale.Apply(others);
  return {FrechetDistance(scaled, scale.Apply(real)), MeanPairDistance(scaled)};
}

FeatureFigures CompareFeatures(const Eigen::MatrixXd& real,
                               const std::vector<WindowFigures>& windows,
                               Eigen::VectorXd WindowFigures::*features) {
  std::vector<Eigen::VectorXd> columns;
  for (const WindowFigures& window : windows) {
    if ((window.*features).size() > 0) columns.push_back(window.*features);
  }
  return CompareFeatures(real, SideBySide(columns));
}

}  // namespace choreo
