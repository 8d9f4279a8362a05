#pragma once

#include "model/messages/model_description.h"
#include "model/plan/model_info.h"

namespace choreo {

/// A model's description for clients. Thread-safe.
ModelDescription DescribeModel(const ModelInfo& model);

}  // namespace choreo
