#pragma once

#include <cstdint>
#include <string>

#include "model/engine/transition_spec.h"
#include "model/motion/control_request.h"
#include "model/motion/velocity_factors.h"

namespace choreo {

/// How lively parts of the body should be, as a client says it.
using VelocityRequest = ControlRequest::VelocityFactors;

/// Throws Error(kInvalidArgument) below `field` for rows and columns that are none, numbers outside
/// [0, kMaxVelocityFactor], or, of speeds, [0, kMaxVelocity], and a reference that the model has
/// not.
void ValidateVelocities(const VelocityRequest& request, const ModelInfo& model,
                        const std::string& field);

bool Names(const VelocityRequest& request, BodyPart part);

/// The velocity factor that it asks of a part that it names, metres a frame. It must be valid.
float SpeedAt(const VelocityRequest& request, int64_t frame, BodyPart part, const ModelInfo& model);

}  // namespace choreo
