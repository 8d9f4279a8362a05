#include "model/evaluation/transition_judge.h"

#include "model/metrics/pose_distance.h"
#include "model/motion/kinematics.h"
#include "model/motion/resample.h"

namespace choreo {

TransitionJudge::TransitionJudge(const ClipSet& set, const ModelInfo& model, int frames,
                                 int windows_per_clip, ProgressBar* progress)
    : set_(set),
      model_(model),
      frames_(frames),
      windows_(ChooseWindows(set, model.history_frames, frames, windows_per_clip)),
      progress_(progress) {}

Figures TransitionJudge::Run(const Method& method, float temperature, uint32_t candidate) const {
  if (method.kind == Method::Kind::kEngine) return Dance(method, temperature, candidate);
  Figures figures;
  for (const EvalWindow& window : windows_) {
    const std::vector<Pose> real = RealPoses(set_, window, frames_, kFramesBefore);
    std::vector<Pose> danced = real;
    if (method.kind == Method::Kind::kInterpolation) {
      for (int t = 0; t + 1 < frames_; ++t) {
        danced[static_cast<size_t>(kFramesBefore + t)] = InterpolatePoses(
            real[kFramesBefore - 1], real.back(), static_cast<double>(t + 1) / frames_);
      }
    }
    figures.push_back(MeasureWindow(model_.skeleton, model_.fps, danced, real));
    figures.back().clip = window.clip;
  }
  return figures;
}

Figures TransitionJudge::Dance(const Method& method, float temperature, uint32_t candidate) const {
  const auto results =
      DanceTransitions(*method.engine, Jobs(method, temperature, candidate), Tick());
  Figures figures;
  for (size_t i = 0; i < windows_.size(); ++i) {
    const std::vector<Pose> real = RealPoses(set_, windows_[i], frames_, kFramesBefore);
    std::vector<Pose> danced(real.begin(), real.begin() + kFramesBefore);
    for (const DanceFrame& frame : results[i].frames) danced.push_back(frame.pose);
    figures.push_back(MeasureWindow(model_.skeleton, model_.fps, danced, real));
    figures.back().clip = windows_[i].clip;
  }
  return figures;
}

void TransitionJudge::AddRawKeys(const Method& method, float temperature, Figures* figures) const {
  std::vector<TransitionJob> jobs = Jobs(method, temperature, 0);
  for (TransitionJob& job : jobs) {
    job.request.arrival.frames = 0;
    job.request.foot_lock = false;
  }
  const auto results = DanceTransitions(*method.engine, jobs, Tick());
  for (size_t i = 0; i < results.size(); ++i) {
    const Pose& danced = results[i].frames.back().pose;
    const Pose key = RealPoses(set_, windows_[i], frames_, 0).back();
    (*figures)[i].raw_key_m = ComparePoses(model_.skeleton, danced, key).position_m;
    (*figures)[i].raw_key_distance = KeyPoseDistance(JointPositions(model_.skeleton, danced),
                                                     JointPositions(model_.skeleton, key));
  }
}

std::vector<TransitionJob> TransitionJudge::Jobs(const Method& method, float temperature,
                                                 uint32_t candidate) const {
  std::vector<TransitionJob> jobs;
  for (size_t i = 0; i < windows_.size(); ++i) {
    jobs.push_back(JobOf(model_, set_, windows_[i], frames_, temperature, i));
    jobs.back().request.candidate = candidate;
    if (!method.keys) jobs.back().request.target.reset();
  }
  return jobs;
}

std::function<void(int)> TransitionJudge::Tick() const {
  return [this](int frames) {
    if (progress_ != nullptr) progress_->Advance(frames, set_.name);
  };
}

}  // namespace choreo
