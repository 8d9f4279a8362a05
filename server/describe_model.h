#pragma once

#include "model/messages/model_description.h"
#include "model/plan/transition_spec.h"

namespace choreo {

/// What clients are told of a model. Thread-safe.
ModelDescription DescribeModel(const ModelInfo& model);

}  // namespace choreo
