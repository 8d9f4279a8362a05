#pragma once

#include <sys/types.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

#include "model/core/files/atomic_file.h"
#include "model/core/grid.h"

namespace choreo {

inline constexpr double kMinVideoFps = 1, kMaxVideoFps = 120;  ///< frames per second

struct VideoFormat {
  int width = 1280, height = 720;  ///< pixels, even, 16 to 8192
  double fps = kModelFps;          ///< kMinVideoFps to kMaxVideoFps
  /// A music file, heard from the first frame to the last; empty: no music.
  std::filesystem::path song;
  double song_start_s = 0;  ///< position in the song at the first frame, seconds
};

/// Files that VideoEncoder writes, by their extensions: H.264 and AAC, VP9 and Opus.
inline constexpr std::array<const char*, 2> kVideoExtensions = {".mp4", ".webm"};

/// Writes a video with the program `ffmpeg`. The file appears only when complete.
/// Deterministic for one version of ffmpeg. Not thread-safe. Members throw Error(kNotFound) if
/// there is no ffmpeg, Error(kInvalidArgument) for other extensions, and sizes and rates outside
/// their limits, and Error(kInternal), whose field is the file and whose message is ffmpeg's, if
/// ffmpeg fails.
class VideoEncoder {
 public:
  /// `frames`: the number of frames to be written, with which the music ends.
  VideoEncoder(const std::filesystem::path& video, const VideoFormat& format, int64_t frames);
  /// Discards the video unless Finish was called.
  ~VideoEncoder();
  VideoEncoder(const VideoEncoder&) = delete;
  VideoEncoder& operator=(const VideoEncoder&) = delete;

  /// Writes the next frame: a picture of the format's size, as Yuv420 returns it.
  void Write(std::span<const uint8_t> yuv);
  /// Completes the file. Call after the last Write.
  void Finish();

 private:
  /// Ends ffmpeg's input and waits for it. Returns whether it succeeded.
  bool Wait();
  [[noreturn]] void Fail();

  std::filesystem::path video_;
  AtomicFile file_;
  pid_t process_ = -1;
  int input_ = -1;     // the write end of ffmpeg's standard input
  int messages_ = -1;  // ffmpeg's standard error
};

}  // namespace choreo
