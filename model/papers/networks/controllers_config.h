#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/core/grid.h"

namespace choreo {

/// Shape and switches of the controllers network (paper C, Section 3.2). Stored in every
/// checkpoint.
struct ControllersConfig {
  std::string name =
      "controllers-paper";  ///< the model's name in servers' lists; by default the preset's
  int history_frames = kHistoryFrames;  ///< tau
  int max_transition_frames = 600;

  /// Of both controllers: window u; heads, width and layers of encoder and decoder; hidden width of
  /// the feed-forward networks; width of the output.
  int window = 7, heads = 8, width = 32, layers = 2, feed_forward = 256, controller = 256;
  int encoder_hidden = 512,
      encoding = 256;        ///< of state encoder, velocity encoder and target controller
  int lstm = 256;            ///< each of the two
  int decoder_hidden = 512;  ///< of the first hidden layer; the second has half

  /// False (the paper): the network outputs whole frames. True: it outputs an offset from
  /// interpolation on the path. A ramp forces the offset to 0 at both ends, so that keys and path
  /// are always met.
  bool residual = false;
  /// The inputs that encode the progress of a transition (Eq. 2): the position on the path, and the
  /// share of frames.
  bool absolute_position = true, relative_position = true;

  /// Switches of the ablations (paper C, Section 4.2).
  bool two_lstms = true;
  bool transformers = true;  ///< false: two fully connected layers in place of each
  bool root_decoder = true;
  bool velocity_factors = true;
  bool key_loss = true;

  static constexpr const char* kPreset = "controllers-paper";
};

void to_json(nlohmann::json& json, const ControllersConfig& config);
void from_json(const nlohmann::json& json, ControllersConfig& config);

}  // namespace choreo
