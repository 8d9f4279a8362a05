#include "model/flow/window/continuous_flow_config.h"

#include "model/core/error.h"
#include "model/core/files/json_struct.h"

namespace choreo {

void ContinuousFlowConfig::Check(const std::string& field) const {
  constexpr int kMaxSteps = 64;
  if (steps < 1 || steps > kMaxSteps)
    throw InvalidArgument(field + ".steps", std::to_string(steps) + " is not in [1, " +
                                                std::to_string(kMaxSteps) + "]");
  plan.Check(field + ".plan");
}

CHOREO_JSON_FIELDS(ContinuousFlowConfig, name, history_frames, window_frames, max_transition_frames,
                   width, layers, heads, condition, steps, temperature, guidance, styles,
                   median_factors, plan)

}  // namespace choreo
