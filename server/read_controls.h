#pragma once

#include <string>

#include "choreo/v1/choreography.pb.h"
#include "model/dance/control_track.h"

namespace choreo {

/// Controls of the API -> ours. Throws Error(kInvalidArgument) below `field` for what has no
/// meaning: no control at all, numbers that make no whole points, a body part that there is not,
/// factors and speeds at once. What has one is for ControlRequest::Validate to judge. Pure,
/// thread-safe.
ControlRequest ToControls(const v1::Controls& controls, const std::string& field);

}  // namespace choreo
