#pragma once

#include <string>
#include <utility>
#include <vector>

#include "model/core/running/slices.h"
#include "model/motion/floor/contacts.h"
#include "model/plan/model_info.h"
#include "model/plan/transition_spec.h"

/// The interface between dances and networks: takes a transition's spec and returns its plan.
/// Independent of torch and gRPC.
namespace choreo {

/// A model's output for a whole transition, in its canonical frame (plan/process_plan.h says what
/// follows).
struct Plan {
  std::vector<Pose> poses;  ///< [frames]
  /// [frames], probability-like, [0, 1]; empty if the model has none of its own.
  std::vector<Contacts> contacts;
  /// [frames] nats (in the model's standardised space, including log-determinants); empty if the
  /// model has no exact ones.
  std::vector<float> log_likelihoods;
  int resampled = 0;  ///< frames sampled beside the first sampling of each
};

/// A model on one device. A plan depends only on model and spec. Not thread-safe: plans are sampled
/// on the thread that owns the sampler.
class Sampler {
 public:
  virtual ~Sampler() = default;
  const ModelInfo& model() const { return model_; }
  const std::string& device() const { return device_; }  ///< "cpu", "cuda:0"

  /// Samples a plan in slices, each so short that a due frame can wait for it. Spec and sampler
  /// must outlive the slices.
  virtual Slices<Plan> Sample(const ValidSpec& spec) = 0;

  /// Seconds per frame, measured by WarmUp; 0 before.
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
