#include <algorithm>

#include "model/dance/transition.h"
#include "model/evaluation/evaluation.h"
#include "model/motion/kinematics.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

double MeanJointDistance(const Skeleton& skeleton, const Pose& a, const Pose& b) {
  return (JointPositions(skeleton, a) - JointPositions(skeleton, b)).colwise().norm().mean();
}

}  // namespace

TransitionRow EvaluateTransitions(StepEngine& engine, const std::vector<PreparedClip>& clips,
                                  int frames, int windows_per_clip, float temperature) {
  const ModelInfo& model = engine.model();
  const int tau = model.history_frames;
  TransitionRow row;
  row.frames = frames;
  for (const PreparedClip& clip : clips) {
    const std::vector<Pose>& poses = clip.motion.frames;
    const int spare = static_cast<int>(poses.size()) - tau - frames;
    if (spare < 0) continue;
    const int count = std::min(windows_per_clip, 1 + spare / frames);
    for (int w = 0; w < count; ++w) {
      const int start = count > 1 ? static_cast<int>(int64_t{spare} * w / (count - 1)) : spare / 2;
      TransitionRequest request;
      request.frames = frames;
      request.history.assign(poses.begin() + start, poses.begin() + start + tau);
      request.target = WorldTarget{poses[static_cast<size_t>(start + tau + frames - 1)], {}};
      request.temperature = temperature;
      request.seed = static_cast<uint64_t>(row.windows);
      Eigen::MatrixXf rows;
      if (clip.audio.cols() > 0) {
        request.has_audio = true;
        request.audio_history = clip.audio.middleCols(start, tau);
        rows = clip.audio.middleCols(start + tau, frames);
      }
      std::optional<ArrivalResult> arrival;
      const std::vector<DanceFrame> dance = RunTransition(engine, request, rows, &arrival);
      double model_sum = 0, line_sum = 0;
      const Pose& from = request.history.back();
      for (int t = 0; t < frames; ++t) {
        const Pose& truth = poses[static_cast<size_t>(start + tau + t)];
        const Pose line =
            InterpolatePoses(from, request.target->pose, static_cast<double>(t + 1) / frames);
        model_sum += MeanJointDistance(model.skeleton, dance[static_cast<size_t>(t)].pose, truth);
        line_sum += MeanJointDistance(model.skeleton, line, truth);
        row.mean_log_likelihood += dance[static_cast<size_t>(t)].log_likelihood / frames;
      }
      row.model_m += model_sum / frames;
      row.interpolation_m += line_sum / frames;
      row.final_key_m = std::max(row.final_key_m, arrival->final_error_m);
      row.final_key_deg = std::max(row.final_key_deg, arrival->final_error_deg);
      // Raw means raw: the same noise, nothing steering towards the key.
      request.arrival.frames = 0;
      RunTransition(engine, request, rows, &arrival);
      row.raw_key_m += arrival->raw_error_m;
      ++row.windows;
    }
  }
  for (double* sum :
       {&row.model_m, &row.interpolation_m, &row.raw_key_m, &row.mean_log_likelihood}) {
    *sum /= std::max(1, row.windows);
  }
  return row;
}

}  // namespace choreo
