#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "model/core/limits.h"
#include "model/messages/model_description.h"
#include "model/motion/controls/controls.h"
#include "model/plan/plan_options.h"

namespace choreo {

/// The music features that a model uses for each frame, besides beats and energy. A model with such
/// features starts a transition once all of the transition's music has arrived.
struct MusicFeatures {
  int count = 0;  ///< numbers per frame; 0: none
  /// Computes a frame's features from the mel bands, in dB.
  void (*row)(std::span<const double> bands, std::span<float> features) = nullptr;

  explicit operator bool() const { return count > 0; }
};

/// A loaded model: what a server reports about it, and what its engine needs besides. Constant for
/// the life of a sampler.
struct ModelInfo : ModelDescription {
  std::string weights = {};         ///< hash of the checkpoint's content
  std::string packed_kernels = {};  ///< PackedKernels::name of its kernels; empty: LibTorch
  /// The frames from a transition's start within which the model sees a later key (LaterTarget). 0:
  /// it sees no later key.
  int sight_frames = 0;
  double max_temperature = kMaxTemperature;  ///< higher values change nothing
  MusicFeatures music_features = {};
  bool plan_stages = false;       ///< whether its plans pass kPlanStages (plan/plan_stages.h)
  PlanOptions plan_options = {};  ///< settings of kPlanStages and of footwork

  bool Supports(std::string_view control) const {
    return std::ranges::find(controls, control) != controls.end();
  }
  bool Supports(size_t row) const { return Supports(kControls[row].name); }
};

/// Throws Error(kInvalidArgument), field "style", unless it is one of the model's or empty.
void CheckStyle(const ModelInfo& model, const std::string& style);

}  // namespace choreo
