#include "model/training/windows/window_body.h"

#include <torch/types.h>
#include <torch/utils.h>

namespace choreo {

using torch::Tensor;

namespace {

Tensor Carriers(const Skeleton& skeleton) {
  const int joints = skeleton.joints();
  const Tensor carriers = torch::zeros({joints, joints});
  for (int j = 0; j < joints; ++j) {
    for (int above = 0; above <= j; ++above)
      if (IsBelow(j, above, skeleton.parents)) carriers[j][above] = 1;
  }
  return carriers;
}

}  // namespace

WindowBody::WindowBody(const Skeleton& skeleton, torch::Device device)
    : kinematics_(skeleton), carriers_(Carriers(skeleton).to(device)) {
  const auto indices = [&](const auto& joints) {
    return torch::tensor(std::vector<int64_t>(joints.begin(), joints.end()), torch::kLong)
        .to(device);
  };
  parents_ = indices(skeleton.parents).clamp_min(0);
  feet_ = indices(skeleton.feet);
}

Tensor WindowBody::Place(const WindowBatch& batch, const Tensor& x) const {
  const torch::NoGradGuard no_grad;
  const int64_t count = x.size(0), window = x.size(1), joints = batch.bones.size(2);
  const Tensor root = batch.base_root + x.narrow(2, 0, 3);
  const Tensor turns = ExpMapBatch(x.narrow(2, 3, 3 * joints).reshape({count, window, joints, 3}));
  return kinematics_
      .Positions(root.flatten(0, 1), torch::matmul(batch.base_turns, turns).flatten(0, 1))
      .reshape({count, window, 3 * joints});
}

Tensor WindowBody::Move(const WindowBatch& batch, const Tensor& dx) const {
  const int64_t joints = batch.bones.size(2);
  const Tensor turns =
      torch::matmul(batch.axes,
                    dx.narrow(2, 3, 3 * joints).reshape(batch.bones.sizes()).unsqueeze(-1))
          .squeeze(-1);
  const Tensor carried = torch::matmul(carriers_, turns).index_select(2, parents_);
  return torch::matmul(carriers_, torch::cross(carried, batch.bones, -1)) +
         dx.narrow(2, 0, 3).unsqueeze(2);
}

}  // namespace choreo
