#pragma once

#include <cstdint>
#include <string>

#include "model/motion/control_request.h"
#include "model/motion/velocity_factors.h"
#include "model/plan/transition_spec.h"

namespace choreo {

/// The requested speeds of body parts, as the client sends them.
using VelocityRequest = ControlRequest::VelocityFactors;

/// Throws Error(kInvalidArgument) below `field` for bad numbers of rows and columns, for factors
/// outside [0, kMaxVelocityFactor] or speeds outside [0, kMaxVelocity], and for a reference that
/// the model lacks.
void ValidateVelocities(const VelocityRequest& request, const ModelInfo& model,
                        const std::string& field);

bool Names(const VelocityRequest& request, BodyPart part);

/// The speed that a valid request sets for a part that it names, metres a frame.
float SpeedAt(const VelocityRequest& request, int64_t frame, BodyPart part, const ModelInfo& model);

}  // namespace choreo
