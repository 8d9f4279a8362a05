#pragma once

#include <string>
#include <vector>

#include "client/authoring/counts.h"
#include "client/choreo_client.h"

namespace choreo::authoring {

/// Whether a source is a file.
bool IsVelocityFile(const std::string& source);

/// Velocity factors of body parts: sources as for `choreo dance --velocity` (docs/song.md), of
/// which one may be a file; multipliers and centimetres exclude each other. Interpolates between a
/// file's points and holds the nearest outside. `reference`: what multipliers refer to; empty: the
/// model's first. Models run at `fps`.
/// `counts`: those of the music, for times in counts. `usual`: what is asked for parts that no
/// source names; its points give way to a file's.
///
/// Throws Error(kInvalidArgument) whose field is "velocity_factors", "velocity_factors.reference"
/// or NAME:factors[i].MEMBER, naming value and limit; Error(kNotFound) for a missing file.
ControlRequest::VelocityFactors ReadVelocities(const std::vector<std::string>& sources,
                                               const std::string& reference, double fps,
                                               const Counts& counts = {},
                                               const ControlRequest::VelocityFactors& usual = {});

}  // namespace choreo::authoring
