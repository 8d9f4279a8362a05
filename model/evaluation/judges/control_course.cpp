#include "model/evaluation/judges/control_course.h"

#include "model/dance/controls/control_track.h"
#include "model/dance/delivery/quality_meter.h"
#include "model/metrics/control_figures.h"
#include "model/metrics/joint_track.h"
#include "model/motion/resample.h"

namespace choreo {

std::vector<Method> WaysOf(const std::vector<Method>& methods) {
  std::vector<Method> ways = {{"real", Method::Kind::kReal},
                              {"interpolation", Method::Kind::kInterpolation}};
  for (const Method& method : methods) {
    if (method.kind != Method::Kind::kModel) continue;
    if (method.Judged()) {
      ways.push_back(method);
      ways.back().name += ", network alone";
      ways.back().finished = false;
    }
    ways.push_back(method);
  }
  return ways;
}

namespace {

std::vector<Pose> WithStart(const Pose& before, const std::vector<Pose>& danced) {
  std::vector<Pose> poses = {before};
  poses.insert(poses.end(), danced.begin(), danced.end());
  return poses;
}

}  // namespace

SpeedTrack SpeedTrackOf(const Skeleton& skeleton, const Pose& before,
                        const std::vector<Pose>& danced) {
  return TrackPartSpeeds(WeighBodyParts(skeleton),
                         TrackJoints(skeleton, WithStart(before, danced)));
}

double SkateRatioOf(const Skeleton& skeleton, double fps, const Pose& before,
                    const std::vector<Pose>& danced) {
  return MeasureMotion(skeleton, {.fps = fps, .frames = WithStart(before, danced)}).skate_ratio;
}

ControlCourse::ControlCourse(const Evaluation& evaluation, int frames)
    : evaluation_(evaluation), model_(evaluation.model()), frames_(frames) {
  for (const EvalWindow& window : ChooseWindows(evaluation.set, model_.history_frames, frames,
                                                evaluation.options.windows_per_clip)) {
    ControlledWindow one{window};
    one.before = RealPoses(evaluation.set, window, 0, 1).front();
    one.real = RealPoses(evaluation.set, window, frames, 0);
    one.key = one.real.back();
    one.path.resize(3, frames);
    for (int t = 0; t < frames; ++t) one.path.col(t) = one.real[t].root_position;
    one.factors = SpeedTrackOf(model_.skeleton, one.before, one.real);
    windows_.push_back(std::move(one));
  }
}

TransitionSpec ControlCourse::RequestFor(size_t window) const {
  TransitionSpec request = RequestOf(model_, evaluation_.set, windows_[window], frames_,
                                     evaluation_.options.temperature, window);
  request.target->pose = windows_[window].key;
  return request;
}

void ControlCourse::Redraw(const Draw& draw) {
  for (size_t i = 0; i < windows_.size(); ++i) {
    ControlRequest controls;
    controls.root_path = draw(&windows_[i]);
    ControlTrack track(model_);
    track.Set(controls, 0, "path");
    TransitionSpec request = RequestFor(i);
    std::vector<Warning> warnings;
    track.FillControls("key", &request, &warnings);
    windows_[i].path = request.controls[kRootPath].values;
    windows_[i].factors.resize(kBodyParts, 0);
  }
}

void ControlCourse::RequestConstant(const std::array<float, kBodyParts>& speeds) {
  for (ControlledWindow& window : windows_) {
    for (int part = 0; part < kBodyParts; ++part)
      window.factors.row(part).setConstant(speeds[part]);
  }
}

Dances ControlCourse::Dance(const Method& way, double scale) const {
  Dances dances;
  if (!way.Lasts(frames_)) return dances;
  if (way.kind != Method::Kind::kModel) {
    for (const ControlledWindow& window : windows_) {
      std::vector<Pose>& poses = dances.emplace_back(window.real);
      if (way.kind == Method::Kind::kReal) continue;
      for (int t = 0; t < frames_; ++t) {
        poses[t] = InterpolatePoses(window.before, window.key, (t + 1.0) / frames_);
        poses[t].root_position = window.path.col(t);
      }
    }
    return dances;
  }
  std::vector<TransitionSpec> requests;
  for (size_t i = 0; i < windows_.size(); ++i) {
    TransitionSpec request = RequestFor(i);
    if (way.FollowsPath()) request.controls[kRootPath].values = windows_[i].path;
    if (way.FollowsVelocityFactors())
      request.controls[kVelocityFactors].values = scale * windows_[i].factors;
    way.Restrict(&request);
    requests.push_back(std::move(request));
  }
  return evaluation_.runner.Dance(*way.sampler, requests);
}

std::vector<ClipFigure> ControlCourse::FiguresOf(const Dances& dances, const Figure& figure) const {
  std::vector<ClipFigure> figures;
  for (size_t i = 0; i < dances.size(); ++i)
    figures.push_back({windows_[i].clip, figure(windows_[i], dances[i])});
  return figures;
}

}  // namespace choreo
