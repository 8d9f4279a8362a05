#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/core/grid.h"
#include "model/core/limits.h"

namespace choreo {

/// Bias and floor of a coupling's delta, which starts near 1. Near 0 the inverse would explode and
/// the likelihood be unbounded; paper F (Eq. 7) does not state how to avoid that.
inline constexpr double kDeltaBias = 2.0, kDeltaFloor = 0.05;
/// Past frames and music are clamped to this many standard deviations: training data ended there.
inline constexpr double kFeatureClamp = 6.0;
/// Sampled frames beyond this many standard deviations are softly limited to one more. So feedback
/// cannot diverge, and roll-outs that exceed the bound keep a gradient.
inline constexpr double kSampleBound = 3.0;
/// The preset of the baseline without a flow (inbetweener.h).
inline constexpr const char* kInbetweenerPreset = "harvey";

/// Shape and training-time switches of the flow model (paper F, Section 3.2). Stored in every
/// checkpoint.
struct FlowConfig {
  std::string name = "paper";  ///< the model's name in servers' lists; by default the preset's
  int history_frames = kHistoryFrames;  ///< tau
  int audio_features = kMfccCount;      ///< MFCCs per row
  bool hears_music = true;              ///< false: music is ignored, as no training clip had any
  int flow_steps = 16;                  ///< K, at least 1
  int hidden = 512;                     ///< width of each coupling's network, a 2-layer LSTM
  int condition_width = 0;  ///< 0: every coupling gets the raw condition (the paper); otherwise
                            ///< width of one shared encoding of it
  /// False (the paper): the flow samples a frame's features. True: it samples the residual of a
  /// linear prediction of each feature from its own past. An input, in the same units, is the
  /// acceleration that would reach the key (AccelerationTo). Small networks are slow to learn
  /// inertia and how to reach a pose. Requires a shared encoding.
  bool innovations = false;
  int max_transition_frames = kMaxTransitionFrames;
  double temperature = 1.0;  ///< default when served

  /// Switches of the ablations.
  bool keys = true;
  bool key_loss = true;
  bool time_embedding = true;
  bool forward_embedding = false;  ///< count frames from the start instead of frames left

  double history_dropout = 0.7;  ///< probability that a whole past frame is dropped in training
  double history_noise =
      0.0;  ///< standard deviation added to past frames in training, in standardised units

  /// The number of music features on which a frame depends: past rows' and its own row's.
  int HeardWidth() const { return (history_frames + 1) * audio_features; }

  /// The shape of a preset. `paper`: as published, 99 M weights. `paper-f`: a twentieth of that,
  /// with a shared encoding of the condition and narrower LSTMs. `ablation`: smaller still.
  /// `harvey`: the baseline. Throws Error(kInvalidArgument) for another name.
  static FlowConfig Preset(const std::string& name);
};

void to_json(nlohmann::json& json, const FlowConfig& config);
void from_json(const nlohmann::json& json, FlowConfig& config);

}  // namespace choreo
