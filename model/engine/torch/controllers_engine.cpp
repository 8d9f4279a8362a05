#include "model/engine/torch/controllers_engine.h"

#include <torch/torch.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "model/core/error.h"
#include "model/engine/dense_controls.h"
#include "model/fit/position_fitter.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

using torch::Tensor;

// Positions leave open how arms are turned about themselves; so many frames ahead of a key that
// goes the key's way, or arrival would have it all to do.
constexpr int kTurnFrames = 30;  // a second
// How much of its last turn a joint is expected to go on with. Expected to rest, it lags behind
// what the network draws; to go on with most of it, elbows swing too far.
constexpr double kCarry = 0.3;
Tensor PointsOf(const Eigen::Matrix3Xd& points) {  // [1, 1, columns, 3]
  const Eigen::Matrix3Xf values = points.cast<float>();
  return torch::from_blob(const_cast<float*>(values.data()), {1, 1, values.cols(), 3}).clone();
}

FrameTensors ToTensors(const FacingPose& pose, const Contacts& contacts) {
  return {PointsOf(pose.root).select(2, 0),
          HeadingOf(torch::full({1, 1}, pose.heading, torch::kFloat32)), PointsOf(pose.joints),
          torch::from_blob(const_cast<float*>(contacts.data()), {1, 1, 4}).clone()};
}

Tensor RowsOf(const Eigen::MatrixXf& columns) {  // [features, N] -> [1, N, features]
  return torch::from_blob(const_cast<float*>(columns.data()), {1, columns.cols(), columns.rows()})
      .clone();
}

Eigen::Matrix3Xd ToPoints(const Tensor& points) {  // [1, 1, columns, 3]
  const Tensor dense = points.contiguous();
  return Eigen::Map<const Eigen::Matrix3Xf>(dense.data_ptr<float>(), 3, dense.size(2))
      .cast<double>();
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

struct ControllersEngine::Slot {
  Slot(const Skeleton& skeleton, double fps)
      : fitter(skeleton, DrawnPositions(skeleton), kFitOptions, fps) {}

  int frames = 0, frame = 0;
  ControlledGiven given;
  ControllersState state;
  FrameTensors walked;  // the lead frames before `frame`
  Tensor contacts;      // that the network named for the last frame, [1, 1, 4]
  Pose before, last;    // the two emitted before `frame`
  std::optional<Pose> target;
  PositionFitter fitter;
};

ControllersEngine::ControllersEngine(ModelInfo info, int slots, ControllersModel model)
    : info_(std::move(info)), model_(std::move(model)), slots_(static_cast<size_t>(slots)) {}

ControllersEngine::~ControllersEngine() = default;

int ControllersEngine::free_slots() const {
  return static_cast<int>(std::count(slots_.begin(), slots_.end(), nullptr));
}

void ControllersEngine::Release(int slot) noexcept { slots_[static_cast<size_t>(slot)].reset(); }

int ControllersEngine::Admit(const TransitionSpec& spec) {
  ValidateSpec(spec, info_);
  const auto free = std::find(slots_.begin(), slots_.end(), nullptr);
  if (free == slots_.end()) {
    throw Error(ErrorCode::kResourceExhausted, "",
                "all " + std::to_string(slots_.size()) + " slots are taken");
  }
  const c10::InferenceMode inference;
  const Skeleton& skeleton = info_.skeleton;
  auto slot = std::make_unique<Slot>(skeleton, info_.fps);
  slot->frames = spec.frames;

  ControlledTransition transition;
  transition.frames = spec.frames;
  const std::vector<Contacts> contacts =
      DetectContacts(skeleton, Motion{.fps = info_.fps, .frames = spec.history});
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
  transition.target_joints = PointsOf(facing.joints).select(1, 0);
  transition.target_turn = torch::full({1}, NearestTurn(facing.heading, 0), torch::kFloat32);
  transition.has_target = torch::full({1, 1}, spec.target ? 1.0F : 0.0F);
  const Controls dense = DenseControls(spec, info_);
  transition.path = RowsOf(dense.root_path);
  transition.factors = RowsOf(dense.velocity_factors);

  slot->given = model_->Prepare(transition);
  slot->walked =
      transition.history.Narrow(transition.history.size() - model_->lead(), model_->lead());
  slot->before = spec.history.size() > 1 ? spec.history[spec.history.size() - 2] : last;
  slot->last = last;
  if (spec.target) slot->target = target;
  *free = std::move(slot);
  return static_cast<int>(free - slots_.begin());
}

void ControllersEngine::StepSlot(const StepInput& in, StepOutput* out) {
  Slot& slot = *slots_[static_cast<size_t>(in.slot)];
  if (in.previous != nullptr) {
    FrameTensors emitted = ToTensors(FacingOf(info_.skeleton, *in.previous), {});
    emitted.contacts = slot.contacts;
    slot.walked = Join(slot.walked.Narrow(1, model_->lead() - 1), emitted);
    slot.before = std::exchange(slot.last, *in.previous);
  }
  const FrameTensors frame =
      model_->Walk(slot.given.Narrow(slot.frame, 1), slot.walked, &slot.state).frames;
  slot.contacts = frame.contacts;
  const Tensor relative = RelativePositions(frame);
  Eigen::Matrix3Xd positions = ToPoints(relative);
  positions.rightCols(positions.cols() - 1).colwise() += positions.col(0).eval();
  // Bones that the network draws too long or too short are the fit's to mend: setting each to its
  // length first would move hands and feet.
  slot.fitter.Reset(InterpolatePoses(slot.before, slot.last, 1 + kCarry));
  std::optional<Pose> after;
  if (const int left = slot.frames - slot.frame; slot.target && left <= kTurnFrames)
    after = InterpolatePoses(slot.last, *slot.target, 1.0 / left);
  out->pose = slot.fitter.Next(positions, after ? &*after : nullptr);
  const Tensor contacts = frame.contacts.contiguous();
  std::copy_n(contacts.data_ptr<float>(), out->contacts.size(), out->contacts.begin());
  out->log_likelihood = 0;
  ++slot.frame;
}

void ControllersEngine::Step(std::span<const StepInput> in, std::span<StepOutput> out) {
  ValidateSteps(in, out.size(), slots(), info_, [this](int number) -> std::optional<SlotProgress> {
    const auto& slot = slots_[static_cast<size_t>(number)];
    if (!slot) return std::nullopt;
    return SlotProgress{slot->frame, slot->frames, false};
  });
  const c10::InferenceMode inference;
  for (size_t i = 0; i < in.size(); ++i) StepSlot(in[i], &out[i]);
}

}  // namespace choreo
