#include "model/training/normalise.h"

#include <torch/torch.h>

#include <algorithm>
#include <cmath>

#include "model/flow/torch_kinematics.h"

namespace choreo {

using torch::Tensor;

namespace {

// Standardised features keep at least these spreads: metres, radians, m/s and rad/s, contacts.
constexpr double kPositionFloor = 0.005, kRotationFloor = 0.01, kVelocityFloor = 0.02,
                 kContactFloor = 0.1;
constexpr double kAudioVarianceFloor = 1e-4;

}  // namespace

void NormaliseAudio(const ClipStore& clips, FlowModel* model) {
  const int width = (*model)->config().audio_features;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(width), square = sum;
  double count = 0;
  for (const auto& clip : clips.clips()) {
    sum += clip.audio.cast<double>().rowwise().sum();
    square += clip.audio.cast<double>().array().square().matrix().rowwise().sum();
    count += static_cast<double>(clip.audio.cols());
  }
  if (count == 0) return;  // no music to learn from
  Tensor mean = torch::empty({width}), std = torch::empty({width});
  for (int i = 0; i < width; ++i) {
    const double m = sum[i] / count;
    mean[i] = m;
    std[i] = std::sqrt(std::max(kAudioVarianceFloor, square[i] / count - m * m));
  }
  (*model)->SetAudioNormalisation(mean, std);
}

void NormaliseFeatures(const std::vector<MotionBatch>& batches, FlowModel* model) {
  torch::NoGradGuard no_grad;
  FlowModel& flow = *model;
  std::vector<Tensor> seen;
  for (const MotionBatch& batch : batches) {
    seen.push_back(batch.features.narrow(1, flow->config().history_frames, batch.transition.frames)
                       .flatten(0, 1));
  }
  const Tensor all = torch::cat(seen).to(torch::kCPU);
  const int64_t joints = flow->skeleton().joints(), width = flow->feature_width();
  Tensor floor = torch::full({width}, kRotationFloor);
  floor.narrow(0, 0, 3).fill_(kPositionFloor);
  floor.narrow(0, 3 + 3 * joints, 3).fill_(kVelocityFloor);
  floor.narrow(0, width - 4, 4).fill_(kContactFloor);
  flow->SetFeatureNormalisation(all.mean(0), torch::maximum(all.std(0), floor));
}

}  // namespace choreo
