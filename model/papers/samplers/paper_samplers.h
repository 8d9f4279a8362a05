#pragma once

#include <string>

#include "model/core/safetensors.h"
#include "model/engine/loading.h"

namespace choreo {

/// Makes samplers of the papers' networks: paper F's flow, paper C's controllers or the baseline of
/// both, depending on the checkpoint; files of no other network are read as paper F's. `name` is
/// what errors call the file. Throws like ParseCheckpoint and ChooseKernels.
SamplerFactory LoadPaperModel(const Safetensors& content, const std::string& name,
                              const EngineRequest& request);

}  // namespace choreo
