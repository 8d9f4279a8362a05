#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <span>

#include "model/core/atomic_file.h"
#include "model/core/grid.h"

namespace choreo {

inline constexpr double kMinVideoFps = 1, kMaxVideoFps = 120;  ///< frames per second

struct VideoFormat {
  int width = 1280, height = 720;  ///< pixels, even, 16 to 8192
  double fps = kModelFps;          ///< kMinVideoFps to kMaxVideoFps
  /// A file with music, from the first frame to the last; empty: none.
  std::filesystem::path song;
  double song_start_s = 0;  ///< second of the song at the first frame
};

/// Writes an MP4 (H.264, AAC) with the program `ffmpeg`. The file appears when complete, or not at
/// all. Deterministic for one version of ffmpeg. Not thread-safe. Members throw Error(kNotFound) if
/// there is no ffmpeg, Error(kInvalidArgument) for sizes and rates outside their limits, and
/// Error(kInternal), whose field is the file and whose message is ffmpeg's, if ffmpeg fails.
class VideoEncoder {
 public:
  /// `frames`: how many will be written; the music ends with them.
  VideoEncoder(const std::filesystem::path& mp4, const VideoFormat& format, int64_t frames);
  /// Discards the video unless Finish was called.
  ~VideoEncoder();
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;

  /// A picture of the format's size, as Yuv420 makes it.
  void Write(std::span<const uint8_t> yuv);
  void Finish();

 private:
  /// Ends ffmpeg's input and waits for it. Returns whether it succeeded.
  bool Wait();
  [[noreturn]] void Fail();

  std::filesystem::path mp4_;
  AtomicFile file_;
  pid_t process_ = -1;
  int input_ = -1;  // our end of its standard input
  int said_ = -1;   // its messages
};

}  // namespace choreo
