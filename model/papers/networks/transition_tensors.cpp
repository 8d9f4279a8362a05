#include "model/papers/networks/transition_tensors.h"

#include <vector>

#include "model/flow/network/torch_kinematics.h"
#include "model/flow/window/time_embedding.h"
#include "model/motion/pose/pose_codec.h"
#include "model/motion/rotation.h"
#include "model/papers/networks/key_condition.h"

namespace choreo {

using torch::Tensor;

TrajectoryTensors Interpolate(const TransitionTensors& transition) {
  const int64_t joints = transition.target_rotation.size(1);
  const Tensor u = torch::arange(1, transition.frames + 1, transition.target_position.options()) /
                   static_cast<double>(transition.frames);
  const Tensor from_position = transition.history_position.select(1, -1);
  const Tensor from_rotation = transition.history_rotation.select(1, -1);
  const Tensor joint_mask = transition.target_mask.narrow(1, 0, joints);
  const Tensor root_mask = transition.target_mask.narrow(1, joints, 1);
  const Tensor move = (transition.target_position - from_position) * root_mask;
  const Tensor turn =
      LogMapBatch(torch::matmul(from_rotation.transpose(-1, -2), transition.target_rotation)) *
      joint_mask.unsqueeze(-1);
  return {from_position.unsqueeze(1) + u.view({1, -1, 1}) * move.unsqueeze(1),
          torch::matmul(from_rotation.unsqueeze(1),
                        ExpMapBatch(u.view({1, -1, 1, 1}) * turn.unsqueeze(1)))};
}

TrajectoryTensors DecodePoses(const Skeleton& skeleton, const Tensor& features) {
  const int64_t joints = skeleton.joints();
  return {features.narrow(-1, PoseCodec::position_at(), 3),
          ExpMapBatch(features.narrow(-1, PoseCodec::rotations_at(), 3 * joints)
                          .reshape({features.size(0), features.size(1), joints, 3}))};
}

Tensor KeyConditionTensors(const FlowConfig& config, const Skeleton& skeleton,
                           const TransitionTensors& transition) {
  const auto here = [](const Tensor& tensor) {
    return tensor.detach().to(torch::kCPU, torch::kFloat64).contiguous();
  };
  const Tensor places = here(transition.target_position), turns = here(transition.target_rotation),
               masks = here(transition.target_mask);
  const int joints = skeleton.joints(), features = PoseCodec(skeleton).width();
  const int width = KeyConditionWidth(config, joints, features);
  const Tensor conditions = torch::empty({places.size(0), transition.frames, width});
  for (int64_t row = 0; row < places.size(0); ++row) {
    const double* turn = turns.data_ptr<double>() + row * 9 * joints;
    const double* mask_row = masks.data_ptr<double>() + row * (joints + 1);
    Pose key{Eigen::Vector3d(places.data_ptr<double>() + row * 3), Eigen::Matrix3Xd(3, joints)};
    PoseMask mask{.root_position = mask_row[joints] > 0, .joints = {}};
    for (int j = 0; j < joints; ++j) {
      using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
      key.rotations.col(j) = LogMap(Eigen::Map<const Matrix>(turn + 9L * j));
      mask.joints.push_back(mask_row[j] > 0);
    }
    const int frames = static_cast<int>(transition.frames);
    Eigen::Map<Eigen::MatrixXf>(conditions[row].data_ptr<float>(), width, frames) =
        KeyConditions(config, joints, features, frames, &key, mask);
  }
  return conditions.to(transition.target_position.device());
}

Tensor TimeEmbedding(const Tensor& counts, int64_t width) {
  const Tensor each = counts.to(torch::kCPU, torch::kFloat64).contiguous();
  const Tensor embedded = torch::empty({counts.numel(), width}, torch::kFloat64);
  for (int64_t i = 0; i < embedded.numel(); ++i) {
    embedded.data_ptr<double>()[i] =
        EmbedCountAt(each.data_ptr<double>()[i / width], static_cast<size_t>(i % width),
                     static_cast<size_t>(width));
  }
  std::vector<int64_t> sizes = counts.sizes().vec();
  sizes.push_back(width);
  return embedded.view(sizes).to(counts.options());
}

}  // namespace choreo
