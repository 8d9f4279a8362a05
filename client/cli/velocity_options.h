#pragma once

#include <string>
#include <vector>

#include "client/choreo_client.h"

namespace choreo::cli {

/// Whether a source is a file.
bool IsVelocityFile(const std::string& source);

/// How lively parts of the body are: each source as `choreo dance --velocity` takes it
/// (docs/song.md), of which one may be a file; multipliers and centimetres exclude each other.
/// Between a file's points values are interpolated, outside the nearest holds. `reference` is what
/// multipliers refer to; empty: the model's first. Models run at `fps`.
///
/// Throws Error(kInvalidArgument) whose field is "--velocity", "--velocity-reference" or
/// NAME:factors[i].MEMBER, naming value and limit; Error(kNotFound) for a file that is not there.
client::Controls::VelocityFactors ReadVelocities(const std::vector<std::string>& sources,
                                                 const std::string& reference, double fps);

}  // namespace choreo::cli
