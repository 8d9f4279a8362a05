#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/engine/transition_spec.h"
#include "model/motion/contacts.h"

/// What stands between the dance and a network: a transition's spec in, its plan out. No torch, no
/// gRPC.
namespace choreo {

/// What a model proposes for a whole transition, in its canonical frame: arrival and footwork come
/// after.
struct Plan {
  std::vector<Pose> poses;         ///< [frames]
  std::vector<Contacts> contacts;  ///< [frames], probability-like, [0, 1]
  /// [frames] nats (model's standardised space, log-determinants included), of models that have an
  /// exact one; else empty.
  std::vector<float> log_likelihoods;
};

/// A transition that is being sampled, slice by slice. Whoever makes a slice may stop behind it,
/// for a while or for good. Not thread-safe.
class Sampling {
 public:
  virtual ~Sampling() = default;
  /// Makes the next slice, short enough that a frame which is due can wait for it. True while more
  /// are left.
  virtual bool Continue() = 0;
  /// Once, when none is left.
  Plan TakePlan() { return std::move(plan_); }

 protected:
  Plan plan_;
};

/// A model on one device. A plan is a function of model and spec alone, whatever else is being
/// sampled. Not thread-safe, and its samplings are continued by the thread that has it; they must
/// not outlive it.
class Sampler {
 public:
  virtual ~Sampler() = default;
  const ModelInfo& model() const { return model_; }
  const std::string& device() const { return device_; }  ///< "cpu", "cuda:0"

  /// Throws Error(kInvalidArgument) for a spec of the wrong shape (ValidateSpec).
  std::unique_ptr<Sampling> Begin(const TransitionSpec& spec);
  /// All slices at once.
  Plan Sample(const TransitionSpec& spec);

  /// What WarmUp has measured; 0 before.
  double seconds_a_frame() const { return seconds_a_frame_; }
  void set_seconds_a_frame(double seconds) { seconds_a_frame_ = seconds; }

 protected:
  Sampler(ModelInfo model, std::string device)
      : model_(std::move(model)), device_(std::move(device)) {}

  /// The spec is valid.
  virtual std::unique_ptr<Sampling> BeginValid(const TransitionSpec& spec) = 0;

  ModelInfo model_;

 private:
  std::string device_;
  double seconds_a_frame_ = 0;
};

}  // namespace choreo
