#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace choreo {

/// The planner, which proposes the whole transition once, from history and key (its mean); width 0
/// means none.
struct PlannerConfig {
  int width = 0;
  bool recurrent = false;  ///< Harvey et al.'s network instead of a transformer
  int layers = 4;
  int heads = 6;
  double dropout = 0;  ///< of what each half of a block adds, in its own training
  int variety = 0;     ///< principal components of what plans leave open (variety.h); 0: none
  /// How far a transformer's plan may turn the root away from interpolation, as the length of what
  /// is added to a column of its rotation: 0.4 is 22 degrees, 1.3 is 52 and more.
  double root_turn = 0.4;
};

/// Sampling around a plan drops past frames that strayed from it, as training drops frames at
/// random: a frame is dropped where a position or rotation is farther away than this many standard
/// deviations, times 1 + the root mean square of the noise. Frames that strayed would be followed
/// farther astray, to where no dance ever was.
inline constexpr float kStrayed = 1.5F;

/// Shape and training-time switches of the flow model (paper F, Section 3.2). Stored in every
/// checkpoint.
struct FlowConfig {
  std::string name = "paper";  ///< as servers list the model; a preset's is its own
  int history_frames = 10;     ///< tau
  int audio_features = 40;     ///< MFCCs a row
  bool hears_music = true;     ///< false: no training clip had music, which is then not listened to
  int flow_steps = 16;         ///< K; 0: no flow, the plan is what is danced
  int hidden = 512;            ///< width of each coupling's network
  bool recurrent = true;    ///< coupling network: 2-layer LSTM (the paper's) or 2-layer perceptron
  int condition_width = 0;  ///< 0: the raw condition goes to every coupling (the paper); else one
                            ///< shared encoding of this width
  PlannerConfig planner;
  int max_transition_frames = 1800;
  double temperature = 1.0;  ///< served by default
  /// Of sampling. Around a varied plan, a frame's own noise is this share of the temperature (times
  /// NoiseShare of engine/temperature.h), and what leaves the plan goes this share of the way to
  /// what the flow proposes in each frame: a low pass, without which frames shake.
  double fine_temperature = 1.0, follow = 1.0;

  /// Switches of the ablations.
  bool keys = true;
  bool key_loss = true;
  bool time_embedding = true;
  bool forward_embedding = false;  ///< count frames from the start instead of frames left

  double history_dropout = 0.7;  ///< probability that a whole past frame is dropped in training
  double history_noise =
      0.0;  ///< standard deviation added to past frames in training, in standardised units

  /// `paper` | `planned` | `ablation` | `recurrent`. Throws Error(kInvalidArgument) for another
  /// name.
  static FlowConfig Preset(const std::string& name);
};

void to_json(nlohmann::json& json, const FlowConfig& config);
void from_json(const nlohmann::json& json, FlowConfig& config);

}  // namespace choreo
