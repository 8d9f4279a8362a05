#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "model/draw/scene.h"
#include "model/draw/video_encoder.h"
#include "model/draw/view.h"

namespace choreo {

struct VideoOptions {
  VideoFormat format;
  /// Times of key poses, seconds from the motion's first frame. A coloured frame appears briefly
  /// around the picture at each.
  std::vector<double> keys;
  std::optional<CameraSide> side;  ///< as in ViewsOf
  /// Called after each frame with the total number of frames; may be empty.
  std::function<void(int64_t frames)> on_frame;
};

/// Draws dancers (scene.h) as a video with music. The camera follows them smoothly. Interpolates if
/// the rate differs from the motions'. Uses all cores; the result does not depend on their number.
/// Throws what VideoEncoder, CheckScene and ViewsOf throw. Thread-safe.
void DrawVideo(const Scene& scene, const VideoOptions& options, const std::filesystem::path& video);

/// The camera's views, one per frame.
std::vector<View> VideoViews(const Scene& scene, double aspect,
                             std::optional<CameraSide> side = {});

}  // namespace choreo
