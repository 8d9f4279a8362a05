#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/core/grid.h"

/// Joint positions of a recorded dancer over time, and corrections that raw recordings need before
/// fitting. Right-handed, Y up, metres, seconds. Corrections expect a clip that passes
/// ValidateClip.
namespace choreo {

struct PositionClip {
  double fps = kModelFps;
  std::vector<std::string> joint_names;  ///< [K]
  std::vector<Eigen::Matrix3Xd> frames;  ///< each [3, K]
};

/// Throws Error(kInvalidArgument) for a clip without frames or rate, and for the first frame with
/// another joint count or a value that is not finite.
void ValidateClip(const PositionClip& clip);

/// Second-order low-pass, run forwards and backwards (zero phase, fourth order in all, Butterworth
/// poles), per coordinate, with ends extended by odd reflection. `cutoff_hz` > 0; at 0.49 fps or
/// more the clip stays as it is.
PositionClip LowPass(const PositionClip& clip, double cutoff_hz);

/// Resamples positions by Catmull-Rom interpolation. First stretches time by `time_scale`: source
/// time t becomes t x time_scale (tang2018 waltz and rumba: 1.0125).
PositionClip ResamplePositions(const PositionClip& clip, double fps, double time_scale = 1.0);

/// Replaces isolated outliers: if a joint is faster than `speed_limit` (m/s) for at most
/// `max_frames` frames, its positions are interpolated between the good frames around. Returns the
/// number of joint samples replaced.
int RemoveSpikes(double speed_limit, int max_frames, PositionClip& clip);

}  // namespace choreo
