#pragma once

#include "model/engine/transition_spec.h"
#include "model/messages/model_description.h"

namespace choreo {

/// What clients are told of a model. Thread-safe.
ModelDescription DescribeModel(const ModelInfo& model);

}  // namespace choreo
