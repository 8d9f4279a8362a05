#pragma once

#include <string>
#include <vector>

#include "client/choreo_client.h"

namespace choreo::cli {

/// Whether a source is a file.
bool IsVelocityFile(const std::string& source);

/// How lively parts of the body are, as people write it down. A source is one of
///
///     left_arm=1.5      a multiplier of the reference, 0 to 10
///     left_arm=1.2cm    a velocity factor, 0 to 50 centimetres a frame
///     FILE.json         either, changing in time:
///
///     {"factors": [{"time": 0, "arms": 1, "trunk": 0.5}, {"time": 2.5, "arms": 3, "trunk": 1}]}
///
/// A part is one of kBodyPartNames, `arms`, `legs` or `all`; within a point no part may be there
/// twice. Each point of a file names the same parts, in order of time; `frame` may stand in place
/// of `time`, so that there can be one a frame. In between values are interpolated, outside the
/// nearest holds. With `speeds` in place of `factors` values are centimetres a frame. `about`,
/// beside them, may say what the file is; any other member is an error.
///
/// Of several sources the last that speaks of a part counts. There may be one file, and multipliers
/// and centimetres exclude each other. `reference` is what multipliers refer to; empty: the model's
/// first. Models run at `fps`.
///
/// Throws Error(kInvalidArgument) whose field is "--velocity", "--velocity-reference" or
/// NAME:factors[i].MEMBER, naming value and limit; Error(kNotFound) for a file that is not there.
client::Controls::VelocityFactors ReadVelocities(const std::vector<std::string>& sources,
                                                 const std::string& reference, double fps);

}  // namespace choreo::cli
