#include "model/evaluation/transition_judge.h"

#include "model/metrics/pose_distance.h"
#include "model/motion/kinematics.h"
#include "model/motion/resample.h"

namespace choreo {

TransitionJudge::TransitionJudge(const Evaluation& evaluation, const ModelInfo& model, int frames)
    : evaluation_(evaluation),
      model_(model),
      frames_(frames),
      windows_(ChooseWindows(evaluation.set, model.history_frames, frames,
                             evaluation.options.windows_per_clip)) {}

Figures TransitionJudge::Run(const Method& method, float temperature, uint32_t candidate) const {
  std::vector<std::vector<Pose>> dances;
  if (method.kind == Method::Kind::kEngine) dances = Dance(method, temperature, candidate);
  Figures figures;
  for (size_t i = 0; i < windows_.size(); ++i) {
    const std::vector<Pose> real = RealPoses(evaluation_.set, windows_[i], frames_, kFramesBefore);
    std::vector<Pose> danced = real;
    for (int t = 0; t < frames_; ++t) {
      Pose& pose = danced[kFramesBefore + t];
      if (method.kind == Method::Kind::kEngine) {
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

std::vector<std::vector<Pose>> TransitionJudge::Dance(const Method& method, float temperature,
                                                      uint32_t candidate) const {
  std::vector<TransitionInput> inputs;
  for (size_t i = 0; i < windows_.size(); ++i) {
    inputs.push_back(InputOf(model_, evaluation_.set, windows_[i], frames_, temperature, i));
    inputs.back().request.candidate = candidate;
    method.Restrict(&inputs.back().request);
  }
  return evaluation_.runner.Dance(*method.engine, inputs);
}

}  // namespace choreo
