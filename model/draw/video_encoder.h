#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "model/core/atomic_file.h"
#include "model/core/grid.h"
#include "model/draw/picture.h"

namespace choreo {

inline constexpr double kMinVideoFps = 1, kMaxVideoFps = 120;  ///< frames a second

struct VideoFormat {
  int width = 1280, height = 720;  ///< pixels, even, 16 to 8192
  double fps = kModelFps;          ///< kMinVideoFps to kMaxVideoFps
  /// A file with music, which is heard from the first frame on and ends with the last; none if
  /// empty.
  std::filesystem::path song;
  double song_start_s = 0;  ///< second of the song that is heard with the first frame
};

/// Writes an MP4 (H.264, AAC) by the program `ffmpeg`. The file appears when it is complete, or not
/// at all. Equal frames and songs give equal bytes for one version of ffmpeg. Not thread-safe.
/// Members throw Error(kNotFound) if there is no ffmpeg, Error(kInvalidArgument) for sizes and
/// rates outside their limits, Error(kInternal) whose field is the file and whose message is
/// ffmpeg's own where it fails.
class VideoEncoder {
 public:
  /// `frames`: how many will be written; the music ends with them.
  VideoEncoder(const std::filesystem::path& mp4, const VideoFormat& format, int64_t frames);
  /// Without Finish, what was written is thrown away.
  ~VideoEncoder();
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;

  /// A picture of the format's size.
  void Write(const Picture& picture);
  void Finish();

 private:
  /// Lets ffmpeg see the end of its input and waits for it; whether it succeeded.
  bool Wait();
  [[noreturn]] void Fail();

  std::filesystem::path mp4_;
  AtomicFile file_;
  pid_t process_ = -1;
  int input_ = -1;  // our end of its standard input
  int said_ = -1;   // what it prints
};

}  // namespace choreo
