#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <span>

#include "model/plan/transition_noise.h"

namespace choreo {

/// The inputs and outputs of FlowStepper::Step for one frame, as in FlowModel::Step.
struct FlowFrame {
  int frame = 0;                 ///< in the transition
  std::span<const float> past;   ///< [tau, width] features in physical units, oldest first
  std::span<const float> audio;  ///< [tau + 1, audio_features] MFCC rows
  bool has_audio = false;        ///< false: `audio` is ignored
  const TransitionNoise* noise = nullptr;
  std::span<float> features;  ///< output, [width], in physical units
  /// Output if the model has an exact one: nats in standardised space.
  std::optional<float> log_likelihood = {};

  /// Writes the frame's noise, whose standard deviation is the temperature.
  void FillNoise(std::span<float> out) const {
    const auto spread = static_cast<float>(noise->temperature);
    if (spread == 0) {
      std::ranges::fill(out, 0.0F);
      return;
    }
    noise->FillNoise(frame, out);
    for (float& value : out) value *= spread;
  }
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
