#include "model/engine/sampler.h"

namespace choreo {

std::unique_ptr<Sampling> Sampler::Begin(const TransitionSpec& spec) {
  ValidateSpec(spec, model_);
  return BeginValid(spec);
}

Plan Sampler::Sample(const TransitionSpec& spec) {
  const std::unique_ptr<Sampling> sampling = Begin(spec);
  while (sampling->Continue()) {
  }
  return sampling->TakePlan();
}

}  // namespace choreo
