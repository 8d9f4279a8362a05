#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/core/grid.h"

/// Joint positions of a recorded dancer over time, and corrections of raw recordings before
/// fitting. Right-handed, Y up, metres, seconds. The corrections expect a clip that passes
/// CheckClip.
namespace choreo {

struct PositionClip {
  double fps = kModelFps;
  std::vector<std::string> joint_names;  ///< [K]
  std::vector<Eigen::Matrix3Xd> frames;  ///< each [3, K]
};

/// Throws Error(kInvalidArgument) for a clip without frames or rate, and names the first frame with
/// another joint count or a value that is not finite.
void CheckClip(const PositionClip& clip);

/// Low-pass filters each coordinate by a second-order Butterworth filter, run forwards and
/// backwards (zero phase, fourth order in all), with ends extended by odd reflection. `cutoff_hz` >
/// 0; from 0.49 * fps on, the clip stays unchanged.
PositionClip LowPass(const PositionClip& clip, double cutoff_hz);

/// Resamples positions by Catmull-Rom interpolation, after stretching time: source time t becomes t
/// * time_scale (tang2018 waltz and rumba: 1.0125).
PositionClip ResamplePositions(const PositionClip& clip, double fps, double time_scale = 1.0);

/// Removes outliers. If a joint is faster than `speed_limit` (m/s) for at most `max_frames` frames,
/// interpolates its positions between the good frames around them. Returns the number of replaced
/// joint samples.
int RemoveSpikes(double speed_limit, int max_frames, PositionClip& clip);

}  // namespace choreo
