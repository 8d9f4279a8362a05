#include "model/papers/samplers/controllers_sampler.h"

#include <torch/types.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "model/fit/solver/position_fitter.h"
#include "model/motion/floor/contacts.h"
#include "model/motion/pose/facing_pose.h"
#include "model/motion/resample.h"
#include "model/papers/samplers/dense_controls.h"

namespace choreo {
namespace {

using torch::Tensor;

// Positions do not determine the twist of arms. From this time before a key on, the twist
// approaches the key's; otherwise arrival would have to make the whole change.
constexpr double kTurnSeconds = 1;
// The share of its last rotation with which a joint is expected to continue. With 0 it lags behind
// the network's output; near 1 elbows overshoot.
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

// Leaves out hands, which hardly move in the recordings and keep the keys' bend: the network's
// output for so short a bone would break wrists. No body fits all of the network's positions, which
// are off by centimetres, so joints prefer their usual rotations to exact positions.
SourceMapping DrawnPositions(const Skeleton& skeleton) {
  SourceMapping mapping = IdentitySource(skeleton, /*hands=*/0);
  mapping.accuracy_m = 0.02;
  return mapping;
}

constexpr FitOptions kFitOptions = {
    .hinge_side_rad = 0.15, .hinge_limit_rad = 0.1, .recover = false};

}  // namespace

/// Computes a transition frame by frame.
class ControllersTransition {
 public:
  ControllersTransition(const ModelInfo& model, ControllersModel network,
                        const TransitionSpec& spec);
  /// Adds the next frame.
  void Step(int frame, Plan* plan);

 private:
  const ModelInfo& model_;
  ControllersModel network_;
  std::optional<Arrival> arrival_;
  int frames_;
  ControlledGiven given_;
  ControllersState state_;
  FrameTensors walked_;  // the lead() frames before the next
  Pose before_, last_;   // the two frames before the next
  std::optional<Pose> target_;
  PositionFitter fitter_;
};

ControllersTransition::ControllersTransition(const ModelInfo& model, ControllersModel network,
                                             const TransitionSpec& spec)
    : model_(model),
      network_(std::move(network)),
      arrival_(ArrivalOf(spec)),
      frames_(spec.frames),
      fitter_(model.skeleton, DrawnPositions(model.skeleton), kFitOptions, model.fps) {
  const c10::InferenceMode inference;
  const Skeleton& skeleton = model_.skeleton;
  ControlledTransition transition;
  transition.frames = spec.frames;
  const std::vector<Contacts> contacts =
      DetectContacts(skeleton, Motion{.fps = model_.fps, .frames = spec.history});
  for (size_t t = 0; t < spec.history.size(); ++t) {
    const FrameTensors frame = ToTensors(FacingOf(skeleton, spec.history[t]), contacts[t]);
    transition.history = t == 0 ? frame : Join(transition.history, frame);
  }
  const Pose& last = spec.history.back();
  Pose target = last;
  if (spec.target) {
    // A joint that the key leaves open keeps its rotation, as in arrival.
    target = Masked(spec.target->pose, {.root_position = false, .joints = spec.target->mask.joints},
                    last);
  }
  const FacingPose facing = FacingOf(skeleton, target);
  transition.target_joints = RowsOf(facing.joints.cast<float>());
  transition.target_turn = torch::full({1}, NearestTurn(facing.heading, 0), torch::kFloat32);
  transition.has_target = torch::full({1, 1}, spec.target ? 1.0F : 0.0F);
  const Controls dense = DenseControls(spec, model_);
  transition.path = RowsOf(dense[kRootPath].values.cast<float>());
  transition.factors = RowsOf(dense[kVelocityFactors].values.cast<float>());

  given_ = network_->Prepare(transition);
  walked_ =
      transition.history.Narrow(transition.history.size() - network_->lead(), network_->lead());
  before_ = spec.history.size() > 1 ? spec.history[spec.history.size() - 2] : last;
  last_ = last;
  if (spec.target) target_ = target;
}

void ControllersTransition::Step(int frame, Plan* plan) {
  const c10::InferenceMode inference;
  const FrameTensors drawn = network_->Walk(given_.Narrow(frame, 1), walked_, &state_).frames;
  const Tensor relative = RelativePositions(drawn).contiguous();  // [1, 1, joints, 3]
  Eigen::Matrix3Xd positions =
      Eigen::Map<const Eigen::Matrix3Xf>(relative.data_ptr<float>(), 3, relative.size(2))
          .cast<double>();
  positions.rightCols(positions.cols() - 1).colwise() += positions.col(0).eval();
  // The fit corrects bones of wrong length. Correcting each bone before it would move hands and
  // feet.
  fitter_.Reset(InterpolatePoses(before_, last_, 1 + kCarry));
  std::optional<Pose> after;
  const int left = frames_ - frame;
  if (target_ && left <= kTurnSeconds * model_.fps)
    after = InterpolatePoses(last_, *target_, 1.0 / left);
  const Pose pose = fitter_.Next(positions, after ? &*after : nullptr);
  const Tensor contacts = drawn.contacts.contiguous();
  std::copy_n(contacts.data_ptr<float>(), Contacts().size(), plan->contacts.emplace_back().begin());
  plan->poses.push_back(pose);

  const Pose steered = arrival_ ? arrival_->Apply(pose) : pose;
  FrameTensors danced = ToTensors(FacingOf(model_.skeleton, steered), {});
  danced.contacts = drawn.contacts;
  walked_ = Join(walked_.Narrow(1, network_->lead() - 1), danced);
  before_ = std::exchange(last_, steered);
}

ControllersSampler::ControllersSampler(ModelInfo info, ControllersModel network)
    : Sampler(std::move(info), "cpu"), network_(std::move(network)) {}

Slices<Plan> ControllersSampler::Sample(const ValidSpec& spec) {
  ControllersTransition walk(model_, network_, *spec);
  Plan plan;
  for (int frame = 0; frame < spec->frames; ++frame) {
    walk.Step(frame, &plan);
    co_await Pause();
  }
  co_return plan;
}

}  // namespace choreo
