#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "model/draw/video_encoder.h"
#include "model/draw/view.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo {

struct VideoOptions {
  VideoFormat format;
  /// Moments of key poses, seconds from the motion's first frame: a frame shows for a moment.
  std::vector<double> keys;
  /// Called after each frame with the number of frames there will be; may be empty.
  std::function<void(int64_t frames)> on_frame;
};

/// Draws a motion as a video with its music. One side is seen all the time, three quarters from the
/// front of the first pose; the camera follows the dancer, unhurriedly. Another rate than the
/// motion's is interpolated. Frames are drawn on every core; the result does not depend on their
/// number. Throws as VideoEncoder, and Error(kInvalidArgument) for a motion without frames.
/// Thread-safe.
void DrawVideo(const Skeleton& skeleton, const Motion& motion, const VideoOptions& options,
               const std::filesystem::path& mp4);

/// The camera's views, one a frame of the motion.
std::vector<View> VideoViews(const Skeleton& skeleton, const Motion& motion, double aspect);

}  // namespace choreo
