#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/core/grid.h"

/// Joint positions of a recorded dancer over time, and the corrections that raw recordings need
/// before rotations are fitted to them. Right-handed, Y up, metres, seconds. Corrections expect
/// what ValidateClip lets pass.
namespace choreo {

struct PositionClip {
  double fps = kModelFps;
  std::vector<std::string> joint_names;  ///< [K]
  std::vector<Eigen::Matrix3Xd> frames;  ///< each [3, K]
};

/// Throws Error(kInvalidArgument) for a clip without frames or rate, and naming the first frame
/// that has another number of joints or a value that is not finite.
void ValidateClip(const PositionClip& clip);

/// Low-pass of second order run forwards and backwards (zero phase, fourth order in all,
/// Butterworth poles), each coordinate by itself, the ends extended by odd reflection. `cutoff_hz`
/// is above 0; at or above 0.49 fps it leaves the clip as it is.
PositionClip LowPass(const PositionClip& clip, double cutoff_hz);

/// Positions at another frame rate by Catmull-Rom interpolation. `time_scale` stretches time first:
/// the moment t of the source stands at t x time_scale in the result (tang2018 waltz and
/// rumba: 1.0125).
PositionClip ResamplePositions(const PositionClip& clip, double fps, double time_scale = 1.0);

/// Replaces isolated outliers: where a joint moves faster than `speed_limit` (m/s) for at most
/// `max_frames` frames, its positions are interpolated between the good frames around. Returns the
/// number of joint samples replaced.
int RemoveSpikes(double speed_limit, int max_frames, PositionClip& clip);

}  // namespace choreo
