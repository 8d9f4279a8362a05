#include "model/engine/torch/controllers_engine.h"

#include <torch/torch.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "model/engine/dense_controls.h"
#include "model/motion/contacts.h"
#include "model/motion/facing_pose.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

using torch::Tensor;

// Positions leave open how arms are turned about themselves; so many frames ahead of a key that
// goes the key's way, or arrival would have it all to do.
constexpr double kTurnSeconds = 1;
// How much of its last turn a joint is expected to go on with. Expected to rest, it lags behind
// what the network draws; to go on with most of it, elbows swing too far.
constexpr double kCarry = 0.3;

Tensor RowsOf(Eigen::MatrixXf columns) {  // [features, N] -> [1, N, features]
  return torch::from_blob(columns.data(), {1, columns.cols(), columns.rows()}).clone();
}

FrameTensors ToTensors(const FacingPose& pose, const Contacts& contacts) {
  return {RowsOf(pose.root.cast<float>()),
          HeadingOf(torch::full({1, 1}, pose.heading, torch::kFloat32)),
          RowsOf(pose.joints.cast<float>()).unsqueeze(1),
          RowsOf(Eigen::Map<const Eigen::Vector4f>(contacts.data()))};
}

// Hands hardly move on the wrists of those who are recorded, and what a network draws of so short a
// bone would break them: they are as bent as the keys have them. It is off by centimetres, and no
// body can be where it draws all joints, so joints keep their usual ways rather than its places.
SourceMapping DrawnPositions(const Skeleton& skeleton) {
  SourceMapping mapping = IdentitySource(skeleton, /*hands=*/0);
  mapping.accuracy_m = 0.02;
  return mapping;
}

constexpr FitOptions kFitOptions = {
    .hinge_side_rad = 0.15, .hinge_limit_rad = 0.1, .recover = false};

}  // namespace

WalkedTransition::WalkedTransition(const ModelInfo& model, int n)
    : frames(n), fitter(model.skeleton, DrawnPositions(model.skeleton), kFitOptions, model.fps) {}

ControllersEngine::ControllersEngine(ModelInfo info, int slots, ControllersModel network)
    : SlotEngine(std::move(info), "cpu", slots), network_(std::move(network)) {}

WalkedTransition ControllersEngine::Begin(const TransitionSpec& spec, int /*slot*/) {
  const c10::InferenceMode inference;
  const Skeleton& skeleton = model().skeleton;
  WalkedTransition walk(model(), spec.frames);

  ControlledTransition transition;
  transition.frames = spec.frames;
  const std::vector<Contacts> contacts =
      DetectContacts(skeleton, Motion{.fps = model().fps, .frames = spec.history});
  for (size_t t = 0; t < spec.history.size(); ++t) {
    const FrameTensors frame = ToTensors(FacingOf(skeleton, spec.history[t]), contacts[t]);
    transition.history = t == 0 ? frame : Join(transition.history, frame);
  }
  const Pose& last = spec.history.back();
  Pose target = last;
  if (spec.target) {
    // A joint that the key leaves open stays as it is on the way; arrival leaves it open too.
    target = Masked(spec.target->pose, {.root_position = false, .joints = spec.target->mask.joints},
                    last);
  }
  const FacingPose facing = FacingOf(skeleton, target);
  transition.target_joints = RowsOf(facing.joints.cast<float>());
  transition.target_turn = torch::full({1}, NearestTurn(facing.heading, 0), torch::kFloat32);
  transition.has_target = torch::full({1, 1}, spec.target ? 1.0F : 0.0F);
  const Controls dense = DenseControls(spec, model());
  transition.path = RowsOf(dense.root_path.cast<float>());
  transition.factors = RowsOf(dense.velocity_factors);

  walk.given = network_->Prepare(transition);
  walk.walked =
      transition.history.Narrow(transition.history.size() - network_->lead(), network_->lead());
  walk.before = spec.history.size() > 1 ? spec.history[spec.history.size() - 2] : last;
  walk.last = last;
  if (spec.target) walk.target = target;
  return walk;
}

void ControllersEngine::StepOne(WalkedTransition* transition, const Pose* previous,
                                StepOutput* out) {
  WalkedTransition& walk = *transition;
  if (previous != nullptr) {
    FrameTensors emitted = ToTensors(FacingOf(model().skeleton, *previous), {});
    emitted.contacts = walk.contacts;
    walk.walked = Join(walk.walked.Narrow(1, network_->lead() - 1), emitted);
    walk.before = std::exchange(walk.last, *previous);
  }
  const FrameTensors frame =
      network_->Walk(walk.given.Narrow(walk.frame, 1), walk.walked, &walk.state).frames;
  walk.contacts = frame.contacts;
  const Tensor relative = RelativePositions(frame).contiguous();  // [1, 1, joints, 3]
  Eigen::Matrix3Xd positions =
      Eigen::Map<const Eigen::Matrix3Xf>(relative.data_ptr<float>(), 3, relative.size(2))
          .cast<double>();
  positions.rightCols(positions.cols() - 1).colwise() += positions.col(0).eval();
  // Bones that the network draws too long or too short are the fit's to mend: setting each to its
  // length first would move hands and feet.
  walk.fitter.Reset(InterpolatePoses(walk.before, walk.last, 1 + kCarry));
  std::optional<Pose> after;
  if (const int left = walk.frames - walk.frame; walk.target && left <= kTurnSeconds * model().fps)
    after = InterpolatePoses(walk.last, *walk.target, 1.0 / left);
  out->pose = walk.fitter.Next(positions, after ? &*after : nullptr);
  const Tensor contacts = frame.contacts.contiguous();
  std::copy_n(contacts.data_ptr<float>(), out->contacts.size(), out->contacts.begin());
  out->log_likelihood.reset();
  ++walk.frame;
}

void ControllersEngine::StepSlots(std::span<const StepInput> in, std::span<StepOutput> out) {
  const c10::InferenceMode inference;
  for (size_t i = 0; i < in.size(); ++i) StepOne(&At(in[i]), in[i].previous, &out[i]);
}

}  // namespace choreo
