#include <algorithm>
#include <numeric>

#include "model/dance/quality_report.h"
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
  std::vector<double> raw;
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
      // The last history frames in front: a jolt at the start counts.
      Motion danced{.fps = model.fps, .frames = {request.history.end() - 2, request.history.end()}};
      Motion real = danced;
      for (int t = 0; t < frames; ++t) {
        danced.frames.push_back(dance[static_cast<size_t>(t)].pose);
        real.frames.push_back(poses[static_cast<size_t>(start + tau + t)]);
      }
      const QualityReport ours = MeasureMotion(model.skeleton, danced);
      const QualityReport theirs = MeasureMotion(model.skeleton, real);
      row.p95_acceleration += ours.p95_acceleration;
      row.max_acceleration = std::max(row.max_acceleration, ours.max_acceleration);
      row.skate_ratio += ours.skate_ratio;
      row.real_p95_acceleration += theirs.p95_acceleration;
      row.real_max_acceleration = std::max(row.real_max_acceleration, theirs.max_acceleration);
      row.real_skate_ratio += theirs.skate_ratio;
      // Raw means raw: the same noise, nothing steering towards the key.
      request.arrival.frames = 0;
      request.foot_lock = false;
      RunTransition(engine, request, rows, &arrival);
      raw.push_back(arrival->raw_error_m);
      if (raw.back() > row.raw_key_worst_m) {
        row.raw_key_worst_m = raw.back();
        row.worst_window = clip.name + "@" + std::to_string(start + tau);
      }
      ++row.windows;
    }
  }
  if (raw.empty()) return row;
  row.raw_key_m = std::accumulate(raw.begin(), raw.end(), 0.0);
  std::ranges::nth_element(raw, raw.begin() + static_cast<std::ptrdiff_t>(raw.size() / 2));
  row.raw_key_median_m = raw[raw.size() / 2];
  for (double* sum : {&row.model_m, &row.interpolation_m, &row.raw_key_m, &row.mean_log_likelihood,
                      &row.p95_acceleration, &row.real_p95_acceleration, &row.skate_ratio,
                      &row.real_skate_ratio}) {
    *sum /= row.windows;
  }
  return row;
}

}  // namespace choreo
