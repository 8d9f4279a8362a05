#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/core/slices.h"
#include "model/motion/contacts.h"
#include "model/plan/transition_spec.h"

/// The interface between dances and networks: a transition's spec in, its plan out. No torch, no
/// gRPC.
namespace choreo {

/// A model's proposal for a whole transition, in its canonical frame; arrival and footwork follow.
struct Plan {
  std::vector<Pose> poses;         ///< [frames]
  std::vector<Contacts> contacts;  ///< [frames], probability-like, [0, 1]
  /// [frames] nats (model's standardised space, including log-determinants), from models with exact
  /// ones; else empty.
  std::vector<float> log_likelihoods;
};

/// A model on one device. A plan is a function of model and spec alone, whatever else is sampled.
/// Not thread-safe; its plans are made on the thread that owns it.
class Sampler {
 public:
  virtual ~Sampler() = default;
  const ModelInfo& model() const { return model_; }
  const std::string& device() const { return device_; }  ///< "cpu", "cuda:0"

  /// Samples a plan, in slices so short that a due frame can wait for one. Spec and sampler must
  /// outlive the slices.
  virtual Slices<Plan> Begin(const ValidSpec& spec) = 0;

  /// Measured by WarmUp; 0 before.
  double seconds_a_frame() const { return seconds_a_frame_; }
  void set_seconds_a_frame(double seconds) { seconds_a_frame_ = seconds; }

 protected:
  Sampler(ModelInfo model, std::string device)
      : model_(std::move(model)), device_(std::move(device)) {}

  ModelInfo model_;

 private:
  std::string device_;
  double seconds_a_frame_ = 0;
};

}  // namespace choreo
