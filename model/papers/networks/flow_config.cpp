#include "model/papers/networks/flow_config.h"

#include "model/core/error.h"
#include "model/core/files/json_struct.h"

namespace choreo {

CHOREO_JSON_FIELDS(FlowConfig, name, history_frames, audio_features, hears_music, flow_steps,
                   hidden, condition_width, innovations, max_transition_frames, temperature, keys,
                   key_loss, time_embedding, forward_embedding, history_dropout, history_noise)

FlowConfig FlowConfig::Preset(const std::string& name) {
  FlowConfig config;
  config.name = name;
  if (name == "paper") return config;
  if (name == "paper-f") {
    config.hidden = 128;
    config.condition_width = 128;
    config.innovations = true;
    return config;
  }
  if (name == "ablation") {
    config.flow_steps = 4;
    config.hidden = 56;
    config.condition_width = 80;
    config.history_noise = 0.1;
    return config;
  }
  if (name == kInbetweenerPreset) {
    config.hidden = 256;
    config.hears_music = false;
    config.temperature = 0;
    return config;
  }
  throw InvalidArgument(
      "preset", "'" + name + "' is none of paper, paper-f, ablation, " + kInbetweenerPreset);
}

}  // namespace choreo
