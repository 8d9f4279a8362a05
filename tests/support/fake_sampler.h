#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/audio/signal/mfcc.h"
#include "model/core/error.h"
#include "model/motion/controls/velocity_factors.h"
#include "model/plan/sampler.h"

namespace choreo {

/// The joints whose rotations show the velocity factors in the fake model's dances, by BodyPart.
inline const std::array<std::string, kBodyParts> kTellingJoints = {
    "head", "left_hand", "right_hand", "left_foot", "right_foot"};

/// A deterministic model without a network, for testing the code around models. Each degree of
/// freedom moves, damped, towards the target (or its last history value if the target leaves it
/// open), with counter-based noise; in models with music input, rows shake it, too. The last joint
/// shows beats, style and the music's energy. A dancer with an open position moves to the middle of
/// the stage. The model misses its target slightly, like a real one. It follows controls exactly:
/// the root is on the path, and the first number of a kTellingJoints rotation is the velocity
/// factor of its part.
class FakeSampler : public Sampler {
 public:
  explicit FakeSampler(std::string device = "fake:0", const Skeleton& skeleton = Skeleton::Smpl24())
      : Sampler({}, std::move(device)) {
    model_.name = "fake";
    model_.fingerprint = "fake-1";
    model_.licence = "none";
    model_.card = R"({"name": "fake"})";
    model_.skeleton = skeleton;
    model_.styles = {"calm", "wild"};
    model_.likelihood = true;
  }

  /// A hook for subclasses, called after each frame. It may change the plan, throw, or wait.
  virtual void OnFrame(const TransitionSpec& /*spec*/, Plan* /*plan*/) {}

  Slices<Plan> Sample(const ValidSpec& spec) override;
};

/// A transition of the fake model, frame by frame.
class FakeTransition {
 public:
  FakeTransition(FakeSampler& sampler, const TransitionSpec& spec)
      : sampler_(sampler),
        model_(sampler.model()),
        spec_(spec),
        arrival_(ArrivalOf(spec)),
        pose_(spec.history.back()),
        velocity_(Eigen::VectorXd::Zero(Width())),
        noise_(static_cast<size_t>(Width())) {}

  /// Adds the next frame.
  void Step(int frame, Plan* plan) {
    spec_.FillNoise(frame, noise_);
    double music = 0;
    if (spec_.music && model_.music_features)
      music = std::tanh(spec_.music->rows.col(frame).cast<double>().sum() / 100.0);
    const double left = spec_.frames - frame;  // reaches the goal in this many steps
    const Eigen::VectorXd now = Flat(pose_);
    velocity_ = 0.5 * velocity_ + 0.5 * (Goal() - now) / left;
    double energy = 0;
    for (int d = 0; d < Width(); ++d) {
      const double z = noise_[static_cast<size_t>(d)];
      energy += z * z;
      velocity_[d] += 0.004 * spec_.temperature * z;
    }
    // Music moves arms and trunk, not feet.
    Eigen::VectorXd next = now + velocity_;
    for (int d = 3; d < Width(); ++d) next[d] += 0.003 * music * std::sin(0.7 * d + frame);
    for (const double beat : spec_.beats)
      next[Width() - 1] += 0.01 * std::max(0.0, 1 - std::abs(beat - frame));
    if (spec_.style == "wild") next[Width() - 2] += 0.01;
    next[Width() - 3] += 0.01 * spec_.energy_shift.now + 0.003 * spec_.energy_shift.before;
    ApplyControls(frame, &next);

    Pose pose;
    pose.root_position = next.head<3>();
    pose.rotations = next.tail(Width() - 3).reshaped(3, model_.skeleton.joints());
    plan->poses.push_back(std::move(pose));
    const float left_down = (spec_.first_frame + frame) / 8 % 2 == 0 ? 1.0F : 0.0F;
    plan->contacts.push_back({left_down, left_down, 1 - left_down, 1 - left_down});
    plan->log_likelihoods.push_back(
        static_cast<float>(-0.5 * energy - 0.9189385332046727 * Width()));
    sampler_.OnFrame(spec_, plan);
    const Pose& drawn = plan->poses.back();
    pose_ = arrival_ ? arrival_->Apply(drawn) : drawn;
  }

 private:
  int Width() const { return 3 + 3 * model_.skeleton.joints(); }

  Eigen::VectorXd Flat(const Pose& pose) const {
    Eigen::VectorXd flat(Width());
    flat << pose.root_position, pose.rotations.reshaped();
    return flat;
  }

  // The target. Open degrees of freedom are the history's last pose, in the middle of the stage.
  Eigen::VectorXd Goal() const {
    Pose last = spec_.history.back();
    const Eigen::Vector3d middle = spec_.stage.value_or(GroundFrame()).origin;
    last.root_position.x() = middle.x();
    last.root_position.z() = middle.z();
    return Flat(spec_.target ? Masked(spec_.target->pose, spec_.target->mask, last) : last);
  }

  // Makes the controls visible in the dance.
  void ApplyControls(int frame, Eigen::VectorXd* next) const {
    const Controls& controls = spec_.controls;
    if (controls[kRootPath].IsGiven()) next->head<3>() = controls[kRootPath].values.col(frame);
    const ControlCurve& factors = controls[kVelocityFactors];
    if (!factors.IsGiven()) return;
    for (int part = 0; part < kBodyParts; ++part) {
      const auto& joint = kTellingJoints[static_cast<size_t>(part)];
      (*next)[3 + 3 * model_.skeleton.Find(joint)] = factors.values(part, frame);
    }
  }

  FakeSampler& sampler_;
  const ModelInfo& model_;
  TransitionSpec spec_;
  std::optional<Arrival> arrival_;
  Pose pose_;  // the frame before, steered by arrival
  Eigen::VectorXd velocity_;
  std::vector<float> noise_;
};

inline Slices<Plan> FakeSampler::Sample(const ValidSpec& spec) {
  FakeTransition transition(*this, *spec);
  Plan plan;
  for (int frame = 0; frame < spec->frames; ++frame) {
    transition.Step(frame, &plan);
    co_await Pause();
  }
  co_return plan;
}

/// A model with music input besides beats, which waits for a whole transition's music.
class HearingSampler : public FakeSampler {
 public:
  HearingSampler() {
    model_.music_features = {kMfccCount,
                             [](std::span<const double> bands, std::span<float> features) {
                               MfccOfMelDb(bands.first<kMelBands>(), features.first<kMfccCount>());
                             }};
  }
};

/// A model with controls.
class ControlledSampler : public FakeSampler {
 public:
  explicit ControlledSampler(const std::string& name = "fake") {
    model_.name = name;
    model_.fingerprint = name + "-controlled";
    model_.controls = ControlNames();
    model_.velocity_references = {{"median", {0.01F, 0.02F, 0.03F, 0.04F, 0.05F}},
                                  {"calm", {0.001F, 0.002F, 0.003F, 0.004F, 0.005F}}};
  }
};

/// Makes samplers of one model, one per worker.
template <typename Model = FakeSampler>
std::vector<std::unique_ptr<Sampler>> FakeSamplers(int workers = 1) {
  std::vector<std::unique_ptr<Sampler>> samplers;
  for (int i = 0; i < workers; ++i) samplers.push_back(std::make_unique<Model>());
  return samplers;
}

}  // namespace choreo
