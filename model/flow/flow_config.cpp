#include "model/flow/flow_config.h"

#include <nlohmann/json.hpp>

#include "model/core/error.h"

namespace choreo {

// One list serves both directions, so that a field can't be written and not read.
#define CHOREO_FLOW_CONFIG_FIELDS(apply)                                                         \
  apply(history_frames) apply(audio_features) apply(hears_music) apply(flow_steps) apply(hidden) \
      apply(condition_width) apply(max_transition_frames) apply(temperature) apply(keys)         \
          apply(key_loss) apply(time_embedding) apply(forward_embedding) apply(history_dropout)  \
              apply(history_noise)

void to_json(nlohmann::json& json, const FlowConfig& config) {
  json = nlohmann::json::object();
  json["name"] = config.name;
#define CHOREO_WRITE(field) json[#field] = config.field;
  CHOREO_FLOW_CONFIG_FIELDS(CHOREO_WRITE)
#undef CHOREO_WRITE
}

void from_json(const nlohmann::json& json, FlowConfig& config) {
  if (json.contains("planner") && json["planner"].value("width", 0) > 0) {
    throw InvalidArgument("planner",
                          "networks around a planner are no longer danced; train "
                          "--preset default");
  }
  if (!json.value("recurrent", true))
    throw InvalidArgument("recurrent", "false: flows without memory are no longer danced");
  json.at("name").get_to(config.name);
#define CHOREO_READ(field) json.at(#field).get_to(config.field);
  CHOREO_FLOW_CONFIG_FIELDS(CHOREO_READ)
#undef CHOREO_READ
}

FlowConfig FlowConfig::Preset(const std::string& name) {
  FlowConfig config;
  config.name = name;
  if (name == "paper") return config;
  if (name == "ablation") {
    config.flow_steps = 4;
    config.hidden = 56;
    config.condition_width = 80;
    config.history_noise = 0.1;
    return config;
  }
  throw InvalidArgument("preset", "'" + name + "' is neither paper nor ablation");
}

}  // namespace choreo
