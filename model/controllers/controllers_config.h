#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace choreo {

/// Shape and switches of the controllers network (paper C, Section 3.2). Stored in every
/// checkpoint.
struct ControllersConfig {
  std::string name = "controllers";  ///< what servers call it; the preset's unless it was named
  int history_frames = 10;           ///< tau
  int max_transition_frames = 600;

  /// The plan: a transformer that sees all that is given of a transition at once. Width 0: none (as
  /// in the paper).
  int plan_width = 192, plan_layers = 4, plan_heads = 6;
  double plan_dropout = 0.1;
  /// Deviation, in frames, of the Gaussian that smooths it in time. A narrow one lets the network
  /// tremble to be as fast as asked (docs/decisions.md, 61).
  double plan_blur = 2;

  /// Both controllers: window u, heads, width and layers of encoder and decoder, hidden width of
  /// their feed-forward networks, width of what they say.
  int window = 7, heads = 8, width = 32, layers = 2, feed_forward = 64, controller = 64;
  int encoder_hidden = 256, encoding = 128;  ///< state and velocity encoder, target controller
  int lstm = 256;                            ///< each of the two
  int decoder_hidden = 256;                  ///< of the first hidden layer; the second has half

  /// Switches of the ablations (paper C, Section 4.2).
  bool two_lstms = true;
  bool transformers = true;  ///< false: two fully connected layers instead of each
  bool root_decoder = true;
  bool velocity_factors = true;
  bool key_loss = true;

  /// `controllers` | `controllers-paper`. Throws Error(kInvalidArgument) for another name.
  static ControllersConfig Preset(const std::string& name);
  static bool IsPreset(const std::string& name);
};

void to_json(nlohmann::json& json, const ControllersConfig& config);
void from_json(const nlohmann::json& json, ControllersConfig& config);

}  // namespace choreo
