#pragma once

#include <string>
#include <vector>

#include "client/authoring/fields/counts.h"
#include "client/choreo_client.h"

namespace choreo::authoring {

/// Whether a source is a file.
bool IsVelocityFile(const std::string& source);

/// Reads velocity factors of body parts. `sources`: as for `choreo dance --velocity`
/// (docs/song.md). One of them may be a file; multipliers and centimetres exclude each other.
/// Interpolates between a file's points and holds the nearest value outside. `reference`: the
/// velocity reference of multipliers; empty: the model's first. `fps`: the model's. `counts`: the
/// music's, for times in counts. `usual`: the request for parts that no source names; a file's
/// points replace its points.
///
/// Throws Error(kInvalidArgument) whose field is "velocity_factors", "velocity_factors.reference"
/// or NAME:factors[i].MEMBER, naming value and limit; Error(kNotFound) for a missing file.
ControlRequest::VelocityFactors ReadVelocities(const std::vector<std::string>& sources,
                                               const std::string& reference, double fps,
                                               const Counts& counts = {},
                                               const ControlRequest::VelocityFactors& usual = {});

}  // namespace choreo::authoring
