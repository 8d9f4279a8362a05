#include "model/flow/network/torch_kinematics.h"

namespace choreo {

using torch::Tensor;
using torch::indexing::Ellipsis;

Tensor ExpMapBatch(const Tensor& w) {
  // The small constant keeps the gradient of the norm finite at zero; its effect on the angle is
  // below 1e-6 rad.
  const Tensor angle = (w.square().sum(-1, true) + 1e-12).sqrt().unsqueeze(-1);  // [..., 1, 1]
  const Tensor axis = w / angle.squeeze(-1);
  const Tensor x = axis.index({Ellipsis, 0}), y = axis.index({Ellipsis, 1}),
               z = axis.index({Ellipsis, 2});
  const Tensor zero = torch::zeros_like(x);
  const Tensor k = torch::stack({zero, -z, y, z, zero, -x, -y, x, zero}, -1).reshape([&] {
    auto shape = w.sizes().vec();
    shape.push_back(3);
    return shape;
  }());
  const Tensor outer = axis.unsqueeze(-1) * axis.unsqueeze(-2);
  const Tensor identity = torch::eye(3, w.options());
  const Tensor cosine = angle.cos();
  return cosine * identity + angle.sin() * k + (1 - cosine) * outer;
}

Tensor LogMapBatch(const Tensor& r) {
  const auto at = [&](int row, int column) { return r.index({Ellipsis, row, column}); };
  const Tensor skew =
      torch::stack({at(2, 1) - at(1, 2), at(0, 2) - at(2, 0), at(1, 0) - at(0, 1)}, -1);
  const Tensor trace = at(0, 0) + at(1, 1) + at(2, 2);
  const Tensor w = 0.5 * (1 + trace).clamp_min(0).sqrt();  // the quaternion's real part
  // The skew part is exact away from pi; near pi it vanishes and the diagonal takes over.
  const Tensor from_skew = skew / (4 * w.clamp_min(0.05)).unsqueeze(-1);
  const Tensor diagonal =
      torch::stack({1 + at(0, 0) - at(1, 1) - at(2, 2), 1 - at(0, 0) + at(1, 1) - at(2, 2),
                    1 - at(0, 0) - at(1, 1) + at(2, 2)},
                   -1);
  const Tensor sign = torch::where(skew < 0, -torch::ones_like(skew), torch::ones_like(skew));
  const Tensor from_diagonal = 0.5 * diagonal.clamp_min(0).sqrt() * sign;
  const Tensor v = torch::where((w > 0.1).unsqueeze(-1), from_skew, from_diagonal);
  const Tensor sine = v.norm(2, -1, true);
  const Tensor angle = 2 * torch::atan2(sine, w.unsqueeze(-1));
  // angle / sin(angle / 2) → 2 as the angle vanishes.
  return torch::where(sine > 1e-6, angle / sine.clamp_min(1e-6), torch::full_like(sine, 2.0)) * v;
}

TorchKinematics::TorchKinematics(const Skeleton& skeleton) {
  const int joints = skeleton.joints();
  std::vector<int64_t> depth(joints, 0), place(joints, 0);
  for (int j = 0; j < joints; ++j) {
    if (j > 0) depth[j] = depth[skeleton.parents[j]] + 1;
    if (static_cast<size_t>(depth[j]) == levels_.size()) levels_.emplace_back();
    Level& level = levels_[depth[j]];
    place[j] = static_cast<int64_t>(level.joints.size());
    level.joints.push_back(j);
    level.parents.push_back(j > 0 ? place[skeleton.parents[j]] : 0);
  }
  order_.resize(joints);
  int64_t next = 0;
  for (const Level& level : levels_) {
    for (const int64_t joint : level.joints) order_[joint] = next++;
  }
  offsets_ = torch::empty({joints, 3}, torch::kFloat64);
  for (int j = 0; j < joints; ++j) {
    for (int axis = 0; axis < 3; ++axis) offsets_[j][axis] = skeleton.offsets(axis, j);
  }
}

Tensor TorchKinematics::Positions(const Tensor& root, const Tensor& rotations) const {
  const auto index = [&](const std::vector<int64_t>& values) {
    return torch::tensor(values, torch::TensorOptions().dtype(torch::kLong).device(root.device()));
  };
  const Tensor offsets = offsets_.to(root.options());
  std::vector<Tensor> positions = {root.unsqueeze(1)};  // by level, [M, joints of the level, 3]
  Tensor global = rotations.index_select(1, index(levels_[0].joints));
  for (size_t depth = 1; depth < levels_.size(); ++depth) {
    const Level& level = levels_[depth];
    const Tensor joints = index(level.joints);
    const Tensor parent_rotation = global.index_select(1, index(level.parents));
    const Tensor parent_position = positions.back().index_select(1, index(level.parents));
    const Tensor offset = offsets.index_select(0, joints);  // [n, 3]
    positions.push_back(parent_position +
                        (parent_rotation * offset.unsqueeze(0).unsqueeze(2)).sum(-1));
    if (depth + 1 < levels_.size()) {
      global = torch::matmul(parent_rotation, rotations.index_select(1, joints));
    }
  }
  return torch::cat(positions, 1).index_select(1, index(order_));
}

}  // namespace choreo
