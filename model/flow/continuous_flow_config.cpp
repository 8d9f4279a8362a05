#include "model/flow/continuous_flow_config.h"

#include <nlohmann/json.hpp>

namespace choreo {

// One list serves both directions, so that a field can't be written and not read.
#define CHOREO_FIELDS(apply)                                                                       \
  apply(name) apply(history_frames) apply(window_frames) apply(max_transition_frames) apply(width) \
      apply(layers) apply(heads) apply(condition) apply(steps) apply(temperature)                  \
          apply(beat_guidance) apply(styles) apply(median_factors)

void to_json(nlohmann::json& json, const ContinuousFlowConfig& config) {
#define CHOREO_WRITE(field) json[#field] = config.field;
  CHOREO_FIELDS(CHOREO_WRITE)
#undef CHOREO_WRITE
}

void from_json(const nlohmann::json& json, ContinuousFlowConfig& config) {
#define CHOREO_READ(field) json.at(#field).get_to(config.field);
  CHOREO_FIELDS(CHOREO_READ)
#undef CHOREO_READ
}

}  // namespace choreo
