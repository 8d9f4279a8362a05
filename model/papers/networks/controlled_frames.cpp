#include "model/papers/networks/controlled_frames.h"

#include "model/motion/controls/velocity_factors.h"

namespace choreo {

using torch::Tensor;

FrameTensors FrameTensors::Narrow(int64_t first, int64_t count) const {
  return {root.narrow(1, first, count), facing.narrow(1, first, count),
          joints.narrow(1, first, count), contacts.narrow(1, first, count)};
}

FrameTensors Join(const FrameTensors& a, const FrameTensors& b) {
  return {torch::cat({a.root, b.root}, 1), torch::cat({a.facing, b.facing}, 1),
          torch::cat({a.joints, b.joints}, 1), torch::cat({a.contacts, b.contacts}, 1)};
}

Tensor Turn(const Tensor& vectors, const Tensor& facing) {
  const Tensor sine = facing.select(-1, 0), cosine = facing.select(-1, 1);
  const Tensor x = vectors.select(-1, 0), z = vectors.select(-1, 2);
  const Tensor turned_x = cosine * x + sine * z;
  return torch::stack({turned_x, vectors.select(-1, 1).expand_as(turned_x), cosine * z - sine * x},
                      -1);
}

Tensor TurnBack(const Tensor& vectors, const Tensor& facing) {
  return Turn(vectors, facing * torch::tensor({-1.0F, 1.0F}, facing.options()));
}

Tensor AddHeadings(const Tensor& a, const Tensor& b) {
  const Tensor sine_a = a.select(-1, 0), cosine_a = a.select(-1, 1);
  const Tensor sine_b = b.select(-1, 0), cosine_b = b.select(-1, 1);
  return torch::stack(
      {sine_a * cosine_b + cosine_a * sine_b, cosine_a * cosine_b - sine_a * sine_b}, -1);
}

Tensor SubtractHeadings(const Tensor& a, const Tensor& b) {
  return AddHeadings(a, b * torch::tensor({-1.0F, 1.0F}, b.options()));
}

Tensor HeadingOf(const Tensor& angle) { return torch::stack({angle.sin(), angle.cos()}, -1); }

Tensor RelativePositions(const FrameTensors& frames) {
  return torch::cat({frames.root.unsqueeze(2), Turn(frames.joints, frames.facing.unsqueeze(2))}, 2);
}

Tensor Steps(const FrameTensors& frames) {
  const Tensor positions = RelativePositions(frames);
  const int64_t count = positions.size(1) - 1;
  return positions.narrow(1, 1, count) - positions.narrow(1, 0, count);
}

Tensor FactorsOf(const Tensor& steps, const Tensor& shares) {
  // The small constant keeps the gradient finite for joints at rest.
  const Tensor speeds = (steps.square().sum(-1) + 1e-10).sqrt();
  return torch::matmul(speeds, shares.transpose(0, 1));
}

Tensor SharesOf(const Skeleton& skeleton) {
  Eigen::Matrix<float, kBodyParts, Eigen::Dynamic, Eigen::RowMajor> shares =
      WeighBodyParts(skeleton).cast<float>();
  return torch::from_blob(shares.data(), {shares.rows(), shares.cols()}).clone();
}

}  // namespace choreo
