#pragma once

#include <cstdint>
#include <string>

#include "choreo/v1/choreography.pb.h"
#include "model/dance/dance_stream.h"
#include "model/dance/transition_group.h"
#include "model/plan/transition_spec.h"

/// Requests of the API -> the dance's own types, checked. Each function throws Error with the path
/// of the field, which begins with `field` where there is one. Pure functions, thread-safe.
namespace choreo {

/// Converts StreamDance's configuration. `fresh_seed` is used where the message has none.
ValidDance ToDanceConfig(const v1::DanceConfig& config, const ModelInfo& model,
                         uint64_t fresh_seed);

/// Converts a GenerateTransition, without the samples of music files, which are decoded later
/// (server/music_file.h).
ValidGroup ToGroupRequest(const v1::GenerateTransitionRequest& request, const ModelInfo& model,
                          uint64_t fresh_seed);

/// Throws if no control is given. ValidateControls checks the values.
ControlRequest ToControls(const v1::Controls& controls, const std::string& field);

}  // namespace choreo
