#include "model/evaluation/judges/transition_judge.h"

#include <algorithm>

#include "model/dance/delivery/quality_meter.h"
#include "model/metrics/frechet.h"
#include "model/metrics/groove.h"
#include "model/metrics/linear.h"
#include "model/metrics/motion_features.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

// `danced` and `real` begin with kFramesBefore frames of history, so that accelerations and skating
// include a jolt at the start. Other figures start after them.
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
  for (size_t t = 0; t < track.size(); ++t)
    figures.l2p_norm += (track[t] - truth[t]).norm() / static_cast<double>(track.size());
  figures.raw_key_distance = figures.key_distance = KeyPoseDistance(track.back(), truth.back());
  const PoseError error = ComparePoses(skeleton, ours.back(), theirs.back());
  figures.raw_key_m = figures.final_key_m = error.position_m;
  figures.final_key_deg = error.angle_deg;
  const Eigen::MatrixXd turns = GlobalQuaternions(skeleton, ours);
  const Eigen::MatrixXd real_turns = GlobalQuaternions(skeleton, theirs);
  figures.l2q = L2Q(turns, real_turns);
  figures.npss = MeasureNpss(turns, real_turns);
  figures.pfc = PhysicalFootContact(skeleton, track);
  figures.pace.Add(track, fps);
  if (track.size() >= 3) figures.kinetic = KineticFeatures(track, fps);
  if (track.size() >= 2 && HasGeometricFeatures(skeleton))
    figures.geometric = GeometricFeatures(skeleton, track, fps);
  return figures;
}

}  // namespace

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

FeatureFigures CompareFeatures(const Eigen::MatrixXd& real, const Figures& windows,
                               Eigen::VectorXd WindowFigures::*features) {
  std::vector<Eigen::VectorXd> columns;
  for (const WindowFigures& window : windows) columns.push_back(window.*features);
  return CompareFeatures(real, SideBySide(columns));
}

TransitionJudge::TransitionJudge(const Evaluation& evaluation, const ModelInfo& model, int frames)
    : evaluation_(evaluation),
      model_(model),
      frames_(frames),
      windows_(ChooseWindows(evaluation.set, model.history_frames, frames,
                             evaluation.options.windows_per_clip)) {}

Figures TransitionJudge::Run(const Method& method, float temperature, uint32_t candidate) const {
  Dances dances;
  if (method.kind == Method::Kind::kModel) dances = Dance(method, temperature, candidate);
  Figures figures;
  for (size_t i = 0; i < windows_.size(); ++i) {
    const std::vector<Pose> real = RealPoses(evaluation_.set, windows_[i], frames_, kFramesBefore);
    std::vector<Pose> danced = real;
    for (int t = 0; t < frames_; ++t) {
      Pose& pose = danced[kFramesBefore + t];
      if (method.kind == Method::Kind::kModel) {
        pose = dances[i][t];
      } else if (method.kind == Method::Kind::kInterpolation && t + 1 < frames_) {
        pose = InterpolatePoses(real[kFramesBefore - 1], real.back(),
                                static_cast<double>(t + 1) / frames_);
      }
    }
    figures.push_back(MeasureWindow(model_.skeleton, model_.fps, danced, real));
    figures.back().clip = windows_[i].clip;
  }
  return figures;
}

void TransitionJudge::AddRawKeys(Method method, float temperature, Figures* figures) const {
  method.finished = false;
  const auto dances = Dance(method, temperature, 0);
  for (size_t i = 0; i < dances.size(); ++i) {
    const Pose& danced = dances[i].back();
    const Pose key = RealPoses(evaluation_.set, windows_[i], frames_, 0).back();
    (*figures)[i].raw_key_m = ComparePoses(model_.skeleton, danced, key).position_m;
    (*figures)[i].raw_key_distance = KeyPoseDistance(JointPositions(model_.skeleton, danced),
                                                     JointPositions(model_.skeleton, key));
  }
}

Dances TransitionJudge::Dance(const Method& method, float temperature, uint32_t candidate) const {
  std::vector<TransitionSpec> requests;
  for (size_t i = 0; i < windows_.size(); ++i) {
    requests.push_back(RequestOf(model_, evaluation_.set, windows_[i], frames_, temperature, i));
    requests.back().candidate = candidate;
    method.Restrict(&requests.back());
  }
  return evaluation_.runner.Dance(*method.sampler, requests);
}

}  // namespace choreo
