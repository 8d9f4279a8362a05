#include "model/flow/continuous_flow_config.h"

#include "model/flow/json_fields.h"

namespace choreo {

CHOREO_JSON_FIELDS(ContinuousFlowConfig, name, history_frames, window_frames, max_transition_frames,
                   width, layers, heads, condition, steps, temperature, guidance, styles,
                   median_factors)

}  // namespace choreo
