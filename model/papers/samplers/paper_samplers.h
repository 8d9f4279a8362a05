#pragma once

#include <string>

#include "model/core/files/safetensors.h"
#include "model/engine/loading.h"

namespace choreo {

/// Makes a factory for samplers of the papers' networks: paper F's flow, paper C's controllers or
/// the baseline of both, depending on the checkpoint. Any other file is read as paper F's. `name`
/// is the file's name in errors. Throws what ParseCheckpoint and ChooseKernels throw.
SamplerFactory LoadPaperModel(const Safetensors& content, const std::string& name,
                              const EngineRequest& request);

}  // namespace choreo
