#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "model/core/numbers/random.h"

namespace choreo {

/// Identifies the noise of a frame.
struct FrameNoise {
  uint64_t seed = 0;
  int64_t frame = 0;  ///< absolute
  uint32_t candidate = 0;
  float spread = 0;  ///< standard deviation, including temperature
  int64_t like = 0;  ///< absolute: the frame that this one repeats with `variation`
  double variation = 0;

  /// Writes FillNormalLike's numbers times the spread.
  void Fill(std::span<float> out) const {
    if (spread == 0) {
      std::ranges::fill(out, 0.0F);
      return;
    }
    FillNormalLike(seed, candidate, frame, like, variation, out);
    for (float& value : out) value *= spread;
  }
};

/// The inputs and outputs of FlowStepper::Step for one frame, as in FlowModel::Step.
struct FlowFrame {
  int frame = 0;                 ///< in the transition
  std::span<const float> past;   ///< [tau, width] features in physical units, oldest first
  std::span<const float> audio;  ///< [tau + 1, audio_features] MFCC rows
  bool has_audio = false;        ///< false: `audio` is ignored
  FrameNoise noise;
  std::span<float> features;  ///< output, [width], in physical units
  /// Output if the model has an exact one: nats in standardised space.
  std::optional<float> log_likelihood = {};
};

/// Runs the flow on one device, with the recurrent state and conditions of one transition. Not
/// thread-safe.
class FlowStepper {
 public:
  virtual ~FlowStepper() = default;
  /// Starts a transition with zero state. `conditions`: [width, frames] from KeyConditions.
  virtual void StartTransition(Eigen::MatrixXf conditions) = 0;
  /// Computes the next frame.
  virtual void Step(FlowFrame* frame) = 0;
};

}  // namespace choreo
