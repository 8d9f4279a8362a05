#pragma once

#include <string>

#include "choreo/v1/choreography.pb.h"
#include "model/motion/control_request.h"

/// Controls <-> the API's, for server, client and studio. Pure functions, thread-safe.
namespace choreo::wire {

/// Throws Error(kInvalidArgument) for a part of the body that there is not.
v1::Controls ToProto(const ControlRequest& controls);

/// Throws Error(kInvalidArgument) below `field` for malformed controls: incomplete points, unknown
/// parts of the body. The engine validates the values.
ControlRequest FromProto(const v1::Controls& controls, const std::string& field);

}  // namespace choreo::wire
