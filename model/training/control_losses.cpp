#include "model/training/control_losses.h"

#include <torch/torch.h>

#include <span>

namespace choreo {
namespace {

using torch::Tensor;

// Paper C, Section 3.3.
constexpr double kRec = 0.3, kCon = 0.2, kRoot = 0.15, kKey = 0.2, kFactor = 0.15;
constexpr int64_t kKeyFrames = 5;  // m
// Within a loss: what counts as one.
constexpr double kHeading = 0.3, kPlace = 2, kContact = 0.05;
constexpr double kCentimetre = 100;

Tensor Norm(const Tensor& x) { return (x.square().sum(-1) + 1e-8).sqrt(); }

// Mean over all but the batch.
Tensor OfWindow(const Tensor& x) { return x.flatten(1).mean(1); }

}  // namespace

Tensor KeyframeLoss(const Tensor& positions, const Tensor& first, const Tensor& last) {
  const int64_t frames = positions.size(1), m = kKeyFrames;
  const Tensor to_first = (positions - first.unsqueeze(1)).square().sum(-1);  // [batch, N]
  const Tensor to_last = (positions - last.unsqueeze(1)).square().sum(-1);
  if (frames > 2 * m) {
    return (to_first.narrow(1, 0, m).sum(1) + to_last.narrow(1, frames - m, m).sum(1)) /
           static_cast<double>(2 * m);
  }
  // As printed the two weights are swapped: a frame would be drawn to the farther pose.
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

  const Tensor rec =
      OfWindow(Norm((frames.joints - truth.joints).flatten(2))) +
      kHeading * OfWindow(Norm(frames.facing - truth.facing)) +
      kPlace * OfWindow(Norm(frames.root - truth.root)) +
      kDecimetresPerMetre * OfWindow(Norm(output.velocities - real)) +
      kContact * OfWindow(torch::binary_cross_entropy_with_logits(
                     output.contact_logits, truth.contacts, {}, {}, at::Reduction::None));
  Tensor consistency = weighted(kDecimetresPerMetre * OfWindow(Norm(steps - real)) +
                                kDecimetresPerMetre * OfWindow(Norm(output.velocities - steps)));

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
  consistency =
      consistency + kDecimetresPerMetre * (bones - lengths.to(bones.device())).abs().mean();
  const Tensor slide = Norm(steps.index_select(2, index(skeleton.feet)) + steps.narrow(2, 0, 1));
  consistency = consistency + kDecimetresPerMetre * (frames.contacts * slide).mean();

  const Tensor root =
      kDecimetresPerMetre * (OfWindow(Norm((steps - real).select(2, 0))) +
                             OfWindow(Norm(frames.facing.diff(1, 1) - truth.facing.diff(1, 1))));
  LossTerms terms = {{"reconstruction", kRec, weighted(rec)},
                     {"consistency", kCon, consistency},
                     {"root", kRoot, weighted(root)}};
  if (model.config().key_loss) {
    const Tensor first = last.joints.select(1, 0).flatten(1);
    const Tensor key =
        KeyframeLoss(frames.joints.flatten(2), first, transition.target_joints.flatten(1));
    terms.push_back({"keyframe", kKey, (key * transition.has_target.squeeze(1)).mean()});
  }
  if (model.config().velocity_factors) {
    terms.push_back(
        {"factors", kFactor,
         kCentimetre * (FactorsOf(steps, model.shares()) - batch.factors).abs().mean()});
  }
  return terms;
}

}  // namespace choreo
