#pragma once

#include <string>

#include "model/core/safetensors.h"
#include "model/engine/loading.h"

namespace choreo {

/// Makes what samples the papers' networks: paper F's flow, paper C's controllers and the baseline
/// of both; the checkpoint says which. `name` is what errors call the file; what is no other
/// network's is read as paper F's. Throws as ParseCheckpoint and ChooseKernels do.
SamplerFactory LoadPaperModel(const Safetensors& content, const std::string& name,
                              const EngineRequest& request);

}  // namespace choreo
