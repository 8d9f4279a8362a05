#include "model/draw/video.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>

#include "model/core/error.h"
#include "model/core/numbers/gaussian_mean.h"
#include "model/core/running/threads.h"
#include "model/draw/render.h"
#include "model/draw/yuv420.h"
#include "model/motion/resample.h"

namespace choreo {
namespace {

constexpr double kKeyGlow = 0.15;  // seconds
constexpr int kFrameShare = 90;    // a key's frame is the picture's height over this wide
constexpr int kSamples = 2;        // the encoder would blur more

// The camera's path over the floor: the dancers' middle, smoothed by a Gaussian, whose window
// reaches as far ahead as back.
std::vector<FramedScene> Follow(const Scene& scene) {
  const double sigma = kCameraLag * scene.front().motion.fps;
  const auto reach = static_cast<int64_t>(std::ceil(3 * sigma));
  const int64_t frames = CountFrames(scene);
  const auto place = [&](int64_t frame) {
    return MiddleOf(scene, std::clamp<int64_t>(frame, 0, frames - 1));
  };
  std::vector<FramedScene> framed;
  for (int64_t frame = 0; frame < frames; ++frame) {
    framed.push_back({frame, GaussianMean<Eigen::Vector2d>(frame - reach, frame + reach, frame,
                                                           sigma, Eigen::Vector2d::Zero(), place)});
  }
  return framed;
}

double Glow(double seconds, const std::vector<double>& keys) {
  double glow = 0;
  for (const double key : keys) {
    const double t = (seconds - key) / kKeyGlow;
    glow = std::max(glow, std::exp(-t * t));
  }
  return glow;
}

// Draws only a border, so that a key does not look like a change of light.
void DrawKeyFrame(double amount, Picture* picture) {
  const int border = std::max(1, picture->height / kFrameShare);
  const double key[] = {kKeyColour.r, kKeyColour.g, kKeyColour.b};
  for (int y = 0; y < picture->height; ++y) {
    const bool whole = y < border || y >= picture->height - border;
    for (int x = 0; x < picture->width; ++x) {
      if (!whole && x == border) x = std::max(x, picture->width - border);
      const auto pixel = 3 * (static_cast<size_t>(y) * static_cast<size_t>(picture->width) +
                              static_cast<size_t>(x));
      for (size_t i = 0; i < 3; ++i) {
        uint8_t& value = picture->rgb[pixel + i];
        value = static_cast<uint8_t>(std::lround(value + amount * (255 * key[i] - value)));
      }
    }
  }
}

}  // namespace

std::vector<View> VideoViews(const Scene& scene, double aspect, std::optional<CameraSide> side) {
  return ViewsOf(scene, Follow(scene), aspect, side);
}

void DrawVideo(const Scene& source, const VideoOptions& options,
               const std::filesystem::path& video) {
  CheckScene(source);
  const VideoFormat& format = options.format;
  Scene scene = source;
  for (SkeletonMotion& dancer : scene) {
    if (dancer.motion.fps != format.fps) dancer.motion = Resample(dancer.motion, format.fps);
  }
  const int64_t frames = CountFrames(scene);
  const std::vector<View> views =
      VideoViews(scene, static_cast<double>(format.width) / format.height, options.side);
  VideoEncoder encoder(video, format, frames);
  const auto draw = [&](int64_t frame) {
    Picture picture{.width = format.width, .height = format.height, .rgb = {}};
    DrawFrame(DollsAt(scene, frame), views[static_cast<size_t>(frame)], {.samples = kSamples},
              picture);
    const double glow = Glow(static_cast<double>(frame) / format.fps, options.keys);
    if (glow > 0.01) DrawKeyFrame(glow, &picture);
    return Yuv420(picture);
  };
  // Draws a few frames ahead and writes them in order.
  std::deque<std::future<std::vector<uint8_t>>> ahead;
  const auto width = static_cast<size_t>(UsableCores());
  int64_t next = 0;
  for (int64_t written = 0; written < frames; ++written) {
    while (next < frames && ahead.size() < width)
      ahead.push_back(std::async(std::launch::async, draw, next++));
    encoder.Write(ahead.front().get());
    ahead.pop_front();
    if (options.on_frame) options.on_frame(frames);
  }
  encoder.Finish();
}

}  // namespace choreo
