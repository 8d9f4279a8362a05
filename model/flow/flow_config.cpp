#include "model/flow/flow_config.h"

#include <nlohmann/json.hpp>

#include "model/core/error.h"

namespace choreo {

// With defaults: checkpoints from before there were two kinds do not name theirs.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(PlannerConfig, width, recurrent, layers, heads,
                                                dropout, variety, root_turn)

// One list serves both directions, so that a field can't be written and not read.
#define CHOREO_FLOW_CONFIG_FIELDS(apply)                                                       \
  apply(history_frames) apply(audio_features) apply(flow_steps) apply(hidden) apply(recurrent) \
      apply(condition_width) apply(planner) apply(max_transition_frames) apply(temperature)    \
          apply(keys) apply(key_loss) apply(time_embedding) apply(forward_embedding)           \
              apply(history_dropout) apply(history_noise)
// What the first checkpoints did not name; there it was what the defaults are.
#define CHOREO_LATER_FIELDS(apply) apply(hears_music) apply(fine_temperature) apply(follow)

void to_json(nlohmann::json& json, const FlowConfig& config) {
  json = nlohmann::json::object();
  json["name"] = config.name;
#define CHOREO_WRITE(field) json[#field] = config.field;
  CHOREO_FLOW_CONFIG_FIELDS(CHOREO_WRITE)
  CHOREO_LATER_FIELDS(CHOREO_WRITE)
#undef CHOREO_WRITE
}

void from_json(const nlohmann::json& json, FlowConfig& config) {
  // The first checkpoints were named after their presets.
  json.at(json.contains("name") ? "name" : "preset").get_to(config.name);
#define CHOREO_READ(field) json.at(#field).get_to(config.field);
  CHOREO_FLOW_CONFIG_FIELDS(CHOREO_READ)
#undef CHOREO_READ
#define CHOREO_READ(field) config.field = json.value(#field, config.field);
  CHOREO_LATER_FIELDS(CHOREO_READ)
#undef CHOREO_READ
}

FlowConfig FlowConfig::Preset(const std::string& name) {
  FlowConfig config;
  config.name = name;
  if (name == "paper") return config;
  if (name == "planned") {
    config.flow_steps = 4;
    config.hidden = 192;
    config.recurrent = false;
    config.condition_width = 256;
    config.planner = {
        .width = 160, .layers = 3, .heads = 5, .dropout = 0.1, .variety = 24, .root_turn = 1.3};
    config.max_transition_frames = 150;
    config.temperature = 0.25;
    config.fine_temperature = 0.15;
    config.follow = 0.5;
    config.history_dropout = 0.7;
    config.history_noise = 0.3;
    return config;
  }
  if (name == "ablation") {
    config.flow_steps = 4;
    config.hidden = 56;
    config.condition_width = 80;
    config.history_noise = 0.1;
    return config;
  }
  if (name == "recurrent") {  // the baseline, on its own
    config.flow_steps = 0;
    config.recurrent = false;
    config.planner = {.width = 320, .recurrent = true};
    config.max_transition_frames = 150;
    config.temperature = 0;
    return config;
  }
  throw InvalidArgument("preset",
                        "'" + name + "' is not one of paper, planned, ablation, recurrent");
}

}  // namespace choreo
