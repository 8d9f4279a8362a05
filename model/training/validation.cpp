#include "model/training/validation.h"

#include <torch/torch.h>

namespace choreo {

std::vector<ValidationRow> Validate(FlowModel& model, const ClipStore& clips,
                                    const std::vector<int>& lengths, int windows) {
  torch::NoGradGuard no_grad;
  const bool was_training = model->is_training();
  model->eval();
  const TorchKinematics kinematics(clips.skeleton());
  const int history = model->config().history_frames;
  const torch::Device device = model->parameters().front().device();
  std::vector<ValidationRow> rows;
  for (const int frames : lengths) {
    Random random(20240607,
                  static_cast<uint32_t>(frames));  // the same windows whenever they are drawn
    const MotionBatch batch = clips.Draw(windows, history, frames, {}, &random).To(device);
    const torch::Tensor condition = model->Begin(batch.transition);
    const auto distance = [&](const TrajectoryTensors& poses) {
      return JointDistance(kinematics, poses, batch.truth).mean().item<double>();
    };
    ValidationRow row{.frames = frames};
    row.interpolation_m = distance(Interpolate(batch.transition));
    const torch::Tensor& truth = batch.features;
    row.likelihood = -model->LogLikelihood(truth, batch.audio, batch.has_audio, condition)
                          .mean()
                          .item<double>() /
                     model->feature_width();
    std::vector<float> values(static_cast<size_t>(truth.size(0)) * frames * truth.size(2));
    random.FillNormal(values);
    const torch::Tensor noise =
        model->config().temperature *
        torch::from_blob(values.data(), {truth.size(0), frames, truth.size(2)}).to(device);
    const torch::Tensor sampled =
        model->Rollout(truth.narrow(1, 0, history), batch.audio, batch.has_audio, condition, noise);
    const TrajectoryTensors poses = model->Decode(sampled);
    row.flow_m = distance(poses);
    const auto last = [&](const TrajectoryTensors& all) {
      return TrajectoryTensors{all.position.narrow(1, frames - 1, 1),
                               all.rotation.narrow(1, frames - 1, 1)};
    };
    row.key_error_m =
        JointDistance(kinematics, last(poses), last(batch.truth)).mean().item<double>();
    rows.push_back(row);
  }
  model->train(was_training);
  return rows;
}

}  // namespace choreo
