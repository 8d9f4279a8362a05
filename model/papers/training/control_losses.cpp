#include "model/papers/training/control_losses.h"

#include <torch/types.h>

#include <span>

namespace choreo {
namespace {

using torch::Tensor;

// Paper C, Section 3.3.
constexpr double kRec = 0.3, kCon = 0.2, kRoot = 0.15, kKey = 0.2, kFactor = 0.15;
constexpr int64_t kKeyFrames = 5;  // m
// Units, which the paper does not state: a decimetre, a centimetre per frame, a third of a radian
// (which moves a hand by a decimetre), a contact.
constexpr double kPlace = 10, kSpeed = 100, kTurn = 3;

Tensor Norm(const Tensor& x) { return (x.square().sum(-1) + 1e-8).sqrt(); }

// Sums over everything but batch and frames, mean over frames: [batch, N, ...] -> [batch].
Tensor OfWindow(const Tensor& x) { return x.flatten(2).sum(2).mean(1); }
Tensor Squares(const Tensor& x) { return OfWindow(x.square()); }

}  // namespace

Tensor KeyframeLoss(const Tensor& positions, const Tensor& first, const Tensor& last) {
  const int64_t frames = positions.size(1), m = kKeyFrames;
  const Tensor to_first = (positions - first.unsqueeze(1)).square().sum(-1);  // [batch, N]
  const Tensor to_last = (positions - last.unsqueeze(1)).square().sum(-1);
  if (frames > 2 * m) {
    return (to_first.narrow(1, 0, m).sum(1) + to_last.narrow(1, frames - m, m).sum(1)) /
           static_cast<double>(2 * m);
  }
  // The paper swaps the two weights, which would pull frames to the farther pose.
  const Tensor u = torch::arange(1, frames + 1, positions.options()) / static_cast<double>(frames);
  return ((1 - u) * to_first + u * to_last).mean(1);
}

LossTerms ControlLoss(ControllersModelImpl& model, const ControlBatch& batch,
                      const ControlledOutput& output) {
  const FrameTensors& frames = output.frames;
  const ControlledTransition& transition = batch.transition;
  const FrameTensors& truth = batch.truth;
  const FrameTensors last = transition.history.Narrow(transition.history.size() - 1, 1);
  const Tensor steps = Steps(Join(last, frames)), real = Steps(Join(last, truth));
  const auto weighted = [&](const Tensor& of_window) { return (batch.weight * of_window).mean(); };

  // Eq. 4
  const Tensor rec = Squares(kPlace * (frames.joints - truth.joints)) +
                     Squares(kPlace * (frames.root - truth.root)) +
                     Squares(kTurn * (frames.facing - truth.facing)) +
                     Squares(kSpeed * (output.velocities - real)) +
                     Squares(frames.contacts - truth.contacts);

  // Eq. 5 to 8
  const Skeleton& skeleton = model.skeleton();
  Tensor lengths = torch::empty({skeleton.joints() - 1});
  for (int j = 1; j < skeleton.joints(); ++j)
    lengths[j - 1] = static_cast<float>(skeleton.offsets.col(j).norm());
  const auto index = [&](std::span<const int> joints) {
    return torch::tensor(std::vector<int64_t>(joints.begin(), joints.end()),
                         frames.joints.options().dtype(torch::kLong));
  };
  const Tensor with_root =
      torch::cat({torch::zeros_like(frames.joints.narrow(2, 0, 1)), frames.joints}, 2);
  const auto parents = std::span(skeleton.parents).subspan(1);
  const Tensor bones = Norm(frames.joints - with_root.index_select(2, index(parents)));
  const Tensor slide = Norm(output.velocities.index_select(2, index(skeleton.feet)) +
                            output.velocities.narrow(2, 0, 1));
  const Tensor consistency = Squares(kPlace * (bones - lengths.to(bones.device()))) +
                             OfWindow(kSpeed * frames.contacts * slide) +
                             Squares(kSpeed * (output.velocities - steps));

  // Eq. 9
  const FrameTensors walked = Join(last, frames);
  const Tensor root =
      Squares(kPlace * walked.root.diff(1, 1)) + Squares(kTurn * walked.facing.diff(1, 1));
  LossTerms terms = {{"reconstruction", kRec, weighted(rec)},
                     {"consistency", kCon, consistency.mean()},
                     {"root", kRoot, root.mean()}};
  if (model.config().key_loss) {  // Eq. 10
    const auto places = [](const Tensor& pelvis, const Tensor& joints) {
      return kPlace * torch::cat({pelvis, joints.flatten(-2)}, -1);
    };
    const Tensor key = KeyframeLoss(
        places(frames.root, frames.joints), places(last.root, last.joints).select(1, 0),
        places(transition.path.select(1, transition.frames - 1), transition.target_joints));
    terms.push_back({"keyframe", kKey, (key * transition.has_target.squeeze(1)).mean()});
  }
  if (model.config().velocity_factors) {  // Eq. 11
    terms.push_back({"factors", kFactor,
                     Squares(kSpeed * (FactorsOf(steps, model.shares()) - batch.factors)).mean()});
  }
  return terms;
}

}  // namespace choreo
