#include "model/controllers/controllers_config.h"

#include <nlohmann/json.hpp>

namespace choreo {

// One list serves both directions, so that a field can't be written and not read.
#define CHOREO_CONTROLLERS_FIELDS(apply)                                                         \
  apply(name) apply(history_frames) apply(max_transition_frames) apply(window) apply(heads)      \
      apply(width) apply(layers) apply(feed_forward) apply(controller) apply(encoder_hidden)     \
          apply(encoding) apply(lstm) apply(decoder_hidden) apply(two_lstms) apply(transformers) \
              apply(root_decoder) apply(velocity_factors) apply(key_loss)

void to_json(nlohmann::json& json, const ControllersConfig& config) {
  json = nlohmann::json::object();
#define CHOREO_WRITE(field) json[#field] = config.field;
  CHOREO_CONTROLLERS_FIELDS(CHOREO_WRITE)
#undef CHOREO_WRITE
}

void from_json(const nlohmann::json& json, ControllersConfig& config) {
#define CHOREO_READ(field) json.at(#field).get_to(config.field);
  CHOREO_CONTROLLERS_FIELDS(CHOREO_READ)
#undef CHOREO_READ
}

}  // namespace choreo
