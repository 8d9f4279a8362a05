#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "model/motion/control_request.h"

/// The path and the velocities that a dance was asked for, in its report: frames of the model.
namespace choreo::cli {

void WriteControls(const ControlRequest& controls, nlohmann::ordered_json* report);
/// Reads those of the report called `name`. Throws Error(kInvalidArgument) whose field is
/// NAME:path or NAME:velocity.
ControlRequest ReadControls(const nlohmann::ordered_json& report, const std::string& name);

/// The controls of a dance that is delayed by so many frames, or, below 0, cut so much later.
ControlRequest Delayed(ControlRequest controls, int64_t frames);
/// Those of a dance whose left and right are exchanged, at the plane x = 0.
ControlRequest Mirrored(ControlRequest controls);

}  // namespace choreo::cli
