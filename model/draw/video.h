#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "model/draw/stage.h"
#include "model/draw/video_encoder.h"
#include "model/draw/view.h"

namespace choreo {

struct VideoOptions {
  VideoFormat format;
  /// Moments of key poses, seconds from the motion's first frame: a frame shows for a moment.
  std::vector<double> keys;
  /// Called after each frame with the number of frames there will be; may be empty.
  std::function<void(int64_t frames)> on_frame;
};

/// Draws dancers (stage.h) as a video with its music. One side is seen all the time; the camera
/// follows them, unhurriedly. Another rate than the motions' is interpolated. Frames are drawn on
/// every core; the result does not depend on their number. Throws as VideoEncoder, and
/// Error(kInvalidArgument) as CheckStage. Thread-safe.
void DrawVideo(const Stage& stage, const VideoOptions& options, const std::filesystem::path& mp4);

/// The camera's views, one a frame.
std::vector<View> VideoViews(const Stage& stage, double aspect);

}  // namespace choreo
