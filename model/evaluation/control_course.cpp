#include "model/evaluation/control_course.h"

#include "model/evaluation/control_figures.h"
#include "model/evaluation/joint_track.h"
#include "model/motion/resample.h"

namespace choreo {

std::vector<ControlledWay> WaysOf(const std::vector<Method>& methods) {
  using Kind = ControlledWay::Kind;
  std::vector<ControlledWay> ways = {{"real", Kind::kReal},
                                     {"interpolation", Kind::kInterpolation}};
  for (const Method& method : methods) {
    if (method.kind != Method::Kind::kEngine) continue;
    if (method.keys)
      ways.push_back({method.name + ", network alone", Kind::kEngine, method.engine, true, false});
    ways.push_back({method.name, Kind::kEngine, method.engine, method.keys});
  }
  return ways;
}

FactorTrack FactorTrackOf(const Skeleton& skeleton, const Pose& before,
                          const std::vector<Pose>& danced) {
  std::vector<Pose> poses = {before};
  poses.insert(poses.end(), danced.begin(), danced.end());
  return TrackVelocityFactors(WeighBodyParts(skeleton), TrackJoints(skeleton, poses));
}

ControlCourse::ControlCourse(const ClipSet& set, const ModelInfo& model, int frames, int per_clip,
                             ProgressBar* progress)
    : set_(set),
      model_(model),
      frames_(frames),
      progress_(progress),
      chosen_(ChooseWindows(set, model.history_frames, frames, per_clip)) {
  for (const EvalWindow& window : chosen_) {
    std::vector<Pose> poses = RealPoses(set, window, frames, 1);
    ControlledWindow one;
    one.clip = window.clip;
    one.before = poses.front();
    one.real.assign(poses.begin() + 1, poses.end());
    one.path.resize(3, frames);
    for (int t = 0; t < frames; ++t)
      one.path.col(t) = one.real[static_cast<size_t>(t)].root_position;
    one.factors = FactorTrackOf(model.skeleton, one.before, one.real);
    windows_.push_back(std::move(one));
  }
}

std::vector<Pose> ControlCourse::Interpolated(const ControlledWindow& window) const {
  std::vector<Pose> poses;
  for (int t = 0; t < frames_; ++t) {
    Pose pose = InterpolatePoses(window.before, window.real.back(), (t + 1.0) / frames_);
    pose.root_position = window.path.col(t);
    poses.push_back(std::move(pose));
  }
  return poses;
}

Dances ControlCourse::Dance(const ControlledWay& way, double scale) const {
  Dances dances;
  if (way.kind != ControlledWay::Kind::kEngine) {
    for (const ControlledWindow& window : windows_) {
      dances.push_back(way.kind == ControlledWay::Kind::kReal ? window.real : Interpolated(window));
    }
    return dances;
  }
  std::vector<TransitionJob> jobs;
  for (size_t i = 0; i < windows_.size(); ++i) {
    TransitionJob job =
        JobOf(model_, set_, chosen_[i], frames_, static_cast<float>(model_.default_temperature), i);
    if (!way.keys) job.request.target.reset();
    if (way.engine->model().root_path) job.request.controls.root_path = windows_[i].path;
    if (way.TakesVelocityFactors())
      job.request.controls.velocity_factors = (scale * windows_[i].factors).cast<float>();
    if (!way.finished) {
      job.request.arrival.frames = 0;
      job.request.foot_lock = false;
    }
    jobs.push_back(std::move(job));
  }
  for (const TransitionResult& result : DanceTransitions(*way.engine, jobs, [this](int danced) {
         if (progress_ != nullptr) progress_->Advance(danced);
       })) {
    std::vector<Pose> poses;
    for (const DanceFrame& frame : result.frames) poses.push_back(frame.pose);
    dances.push_back(std::move(poses));
  }
  return dances;
}

Cell ControlCourse::MeanOf(const Dances& dances, const Figure& figure) const {
  std::vector<ClipFigure> figures;
  for (size_t i = 0; i < dances.size(); ++i)
    figures.push_back({windows_[i].clip, figure(windows_[i], dances[i])});
  return Mean(figures);
}

}  // namespace choreo
