#include "model/engine/sampler.h"

namespace choreo {

Slices<Plan> Sampler::Begin(const TransitionSpec& spec) {
  ValidateSpec(spec, model_);
  return BeginValid(spec);
}

}  // namespace choreo
