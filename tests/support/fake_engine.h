#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/random.h"
#include "model/engine/step_engine.h"
#include "model/motion/velocity_factors.h"

namespace choreo {

/// Joints by which the fake model tells of velocity factors, by BodyPart.
inline const std::array<std::string, kBodyParts> kTellingJoints = {
    "head", "left_hand", "right_hand", "left_foot", "right_foot"};

/// A dance model without a network, for tests of what stands around one. Each degree of freedom
/// walks towards the target (or towards its last history value, where there is none or it is
/// masked), damped, shaken by the counter noise and by the music row, and nods on the beats.
/// Whose place nobody says goes to the middle of the stage. Deterministic; a slot's output depends
/// on its spec, its rows and its fed-back poses alone. Like a real model it misses its target by a
/// little. Controls it obeys to the letter: its root stands on the path, and the first number of a
/// telling joint's rotation is the velocity factor asked of the joint's part.
class FakeEngine : public StepEngine {
 public:
  explicit FakeEngine(int slots = 16, std::string device = "fake:0",
                      const Skeleton& skeleton = Skeleton::Smpl24())
      : device_(std::move(device)), slots_(static_cast<size_t>(slots)) {
    model_.name = "fake";
    model_.fingerprint = "fake-1";
    model_.licence = "none";
    model_.card = R"({"name": "fake"})";
    model_.skeleton = skeleton;
    model_.styles = {"calm", "wild"};
    noise_.resize(static_cast<size_t>(Width()));
  }

  const ModelInfo& model() const override { return model_; }
  std::string device() const override { return device_; }
  int slots() const override { return static_cast<int>(slots_.size()); }
  int free_slots() const override {
    return static_cast<int>(std::count_if(slots_.begin(), slots_.end(),
                                          [](const Slot& slot) { return !slot.spec.has_value(); }));
  }

  int BeginAdmission(const TransitionSpec& spec) override {
    ValidateSpec(spec, model_);
    const auto free = std::find_if(slots_.begin(), slots_.end(),
                                   [](const Slot& slot) { return !slot.spec.has_value(); });
    if (free == slots_.end()) throw Error(ErrorCode::kResourceExhausted, "", "no free slot");
    free->spec = spec;
    free->frame = 0;
    free->pose = spec.history.back();
    free->velocity = Eigen::VectorXd::Zero(Width());
    return static_cast<int>(free - slots_.begin());
  }

  void Step(std::span<const StepInput> in, std::span<StepOutput> out) override {
    for (size_t i = 0; i < in.size(); ++i) StepSlot(in[i], &out[i]);
  }

  void Release(int slot) noexcept override { slots_[static_cast<size_t>(slot)].spec.reset(); }

 protected:
  ModelInfo model_;  // subclasses may change it in their constructors

 private:
  struct Slot {
    std::optional<TransitionSpec> spec;  // none: free
    int frame = 0;
    Pose pose;
    Eigen::VectorXd velocity;
  };

  int Width() const { return 3 + 3 * model_.skeleton.joints(); }

  Eigen::VectorXd Flat(const Pose& pose) const {
    Eigen::VectorXd flat(Width());
    flat << pose.root_position, pose.rotations.reshaped();
    return flat;
  }

  // The history's last pose where the target does not ask for a degree of freedom, on the stage.
  Eigen::VectorXd Goal(const TransitionSpec& spec) const {
    Pose last = spec.history.back();
    const Eigen::Vector3d stage = spec.stage.value_or(Eigen::Vector3d::Zero());
    last.root_position.x() = stage.x();
    last.root_position.z() = stage.z();
    return Flat(spec.target ? Masked(spec.target->pose, spec.target->mask, last) : last);
  }

  void StepSlot(const StepInput& in, StepOutput* out) {
    Slot& slot = slots_[static_cast<size_t>(in.slot)];
    const TransitionSpec& spec = *slot.spec;
    if (in.previous != nullptr) slot.pose = *in.previous;
    FillNormal(spec.seed, spec.candidate, spec.first_frame + slot.frame, noise_);
    double music = 0;
    if (spec.has_audio) {
      for (float value : in.audio_row) music += value;
      music = std::tanh(music / 100.0);
    }
    const double left = spec.frames - slot.frame;  // the goal is reached in this many steps
    const Eigen::VectorXd now = Flat(slot.pose);
    const Eigen::VectorXd wanted = (Goal(spec) - now) / left;
    slot.velocity = 0.5 * slot.velocity + 0.5 * wanted;
    double energy = 0;
    for (int d = 0; d < Width(); ++d) {
      const double z = noise_[static_cast<size_t>(d)];
      energy += z * z;
      slot.velocity[d] += 0.004 * spec.temperature * z;
    }
    // Music sways the arms and the trunk, not the place of the feet.
    Eigen::VectorXd next = now + slot.velocity;
    for (int d = 3; d < Width(); ++d) next[d] += 0.003 * music * std::sin(0.7 * d + slot.frame);
    for (const double beat : spec.beats)
      next[Width() - 1] += 0.01 * std::max(0.0, 1 - std::abs(beat - slot.frame));
    if (spec.style == "wild") next[Width() - 2] += 0.01;
    Obey(spec.controls, slot.frame, &next);

    slot.pose.root_position = next.head<3>();
    slot.pose.rotations = next.tail(Width() - 3).reshaped(3, model_.skeleton.joints());
    out->pose = slot.pose;
    const float left_down = (spec.first_frame + slot.frame) / 8 % 2 == 0 ? 1.0F : 0.0F;
    out->contacts = {left_down, left_down, 1 - left_down, 1 - left_down};
    out->log_likelihood = static_cast<float>(-0.5 * energy - 0.9189385332046727 * Width());
    ++slot.frame;
  }

  // So that a test can see in the dance what was asked of the model.
  void Obey(const Controls& controls, int frame, Eigen::VectorXd* next) const {
    if (controls.root_path.cols() > 0) next->head<3>() = controls.root_path.col(frame);
    if (controls.velocity_factors.cols() == 0) return;
    for (int part = 0; part < kBodyParts; ++part) {
      const auto& joint = kTellingJoints[static_cast<size_t>(part)];
      (*next)[3 + 3 * model_.skeleton.Find(joint)] = controls.velocity_factors(part, frame);
    }
  }

  std::string device_;
  std::vector<Slot> slots_;
  std::vector<float> noise_;
};

/// One that takes controls.
class ControlledEngine : public FakeEngine {
 public:
  explicit ControlledEngine(int slots = 16, const std::string& name = "fake") : FakeEngine(slots) {
    model_.name = name;
    model_.fingerprint = name + "-controlled";
    model_.root_path = model_.velocity_factors = true;
    model_.velocity_references = {{"median", {0.01F, 0.02F, 0.03F, 0.04F, 0.05F}},
                                  {"calm", {0.001F, 0.002F, 0.003F, 0.004F, 0.005F}}};
  }
};

}  // namespace choreo
