#include "model/draw/video_encoder.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/core/files/small_extension.h"
#include "model/core/joined.h"
#include "model/draw/check_within.h"

namespace choreo {
namespace {

void CheckFormat(const VideoFormat& format) {
  for (const auto& [field, pixels] :
       {std::pair("video.width", format.width), std::pair("video.height", format.height)}) {
    CheckWithin(field, pixels, 16, 8192);
    if (pixels % 2 != 0)
      throw InvalidArgument(field, std::to_string(pixels) + ", must be an even number of pixels");
  }
  CheckWithin("video.fps", format.fps, kMinVideoFps, kMaxVideoFps);
}

// "file:" keeps ffmpeg from reading a name as a protocol or an option.
std::string FileUrl(const std::filesystem::path& path) { return "file:" + path.string(); }

/// What a kind of file needs besides the pictures: ffmpeg's options.
struct FileKind {
  const char* extension;
  std::vector<std::string> sound, picture;
};

const FileKind& KindOf(const std::filesystem::path& video) {
  static const FileKind kKinds[] = {
      {kVideoExtensions[0],
       {"-c:a", "aac", "-aac_coder", "fast", "-b:a", "192k"},
       {"-c:v", "libx264", "-preset", "veryfast", "-x264-params", "subme=1", "-crf", "18",
        "-movflags", "+faststart", "-f", "mp4"}},
      // VP9's own rate is off, so that -crf determines the quality.
      {kVideoExtensions[1],
       {"-c:a", "libopus", "-b:a", "160k"},
       {"-c:v", "libvpx-vp9", "-deadline", "good", "-cpu-used", "5", "-row-mt", "1", "-crf", "28",
        "-b:v", "0", "-f", "webm"}}};
  const std::string extension = SmallExtension(video);
  for (const FileKind& kind : kKinds)
    if (extension == kind.extension) return kind;
  throw InvalidArgument(video.string(),
                        "does not end in " + Joined(kVideoExtensions, std::identity(), " or "));
}

std::vector<std::string> Arguments(const VideoFormat& format, int64_t frames, const FileKind& kind,
                                   const std::filesystem::path& out) {
  std::vector<std::string> arguments = {
      "ffmpeg", "-hide_banner", "-loglevel", "error", "-nostdin", "-y",
      // Frames in order, as Yuv420 makes them.
      "-f", "rawvideo", "-pixel_format", "yuv420p", "-framerate", std::to_string(format.fps),
      "-video_size", std::to_string(format.width) + "x" + std::to_string(format.height), "-i",
      "pipe:0"};
  const auto add = [&](const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
  };
  if (!format.song.empty()) {
    // A song may contain cover art, which would be a second picture.
    add({"-ss", std::to_string(format.song_start_s), "-i", FileUrl(format.song), "-map", "0:v:0",
         "-map", "1:a:0"});
    add(kind.sound);
  }
  add({// Players assume BT.709 for unmarked files, which would shift our colours.
       "-colorspace", "bt709", "-color_range", "tv", "-color_primaries", "bt709", "-color_trc",
       "bt709", "-t", std::to_string(static_cast<double>(frames) / format.fps), "-fflags",
       "+bitexact", "-flags", "+bitexact"});
  add(kind.picture);
  add({FileUrl(out)});
  return arguments;
}

}  // namespace

VideoEncoder::VideoEncoder(const std::filesystem::path& video, const VideoFormat& format,
                           int64_t frames)
    : video_(video), file_(video) {
  CheckFormat(format);
  const FileKind& kind = KindOf(video);
  // Uses a socket, not a pipe, so that writing to a dead ffmpeg is an error, not a signal.
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw Error(ErrorCode::kInternal, "", std::string("socketpair: ") + std::strerror(errno));
  input_ = ends[0];
  // ffmpeg's messages go to memory, so that it never waits for a reader.
  messages_ = memfd_create("ffmpeg", MFD_CLOEXEC);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages_, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages_, STDERR_FILENO);
  std::vector<std::string> arguments = Arguments(format, frames, kind, file_.partial());
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const int failed = posix_spawnp(&process_, "ffmpeg", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (failed != 0) {
    close(input_);
    close(messages_);
    if (failed == ENOENT) {
      throw Error(ErrorCode::kNotFound, "ffmpeg",
                  "is not installed, and videos need it: scripts/install_packages.sh video");
    }
    throw Error(ErrorCode::kInternal, "ffmpeg", std::strerror(failed));
  }
}

VideoEncoder::~VideoEncoder() {
  if (process_ > 0) kill(process_, SIGKILL);
  Wait();
  close(messages_);
}

void VideoEncoder::Write(std::span<const uint8_t> yuv) {
  while (!yuv.empty()) {
    const ssize_t sent = send(input_, yuv.data(), yuv.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) Fail();
    yuv = yuv.subspan(static_cast<size_t>(sent));
  }
}

void VideoEncoder::Finish() {
  if (!Wait()) Fail();
  file_.Commit();
}

bool VideoEncoder::Wait() {
  if (input_ >= 0) close(std::exchange(input_, -1));
  int status = 1;
  while (process_ > 0 && waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void VideoEncoder::Fail() {
  Wait();
  std::string messages(4096, '\0');
  const ssize_t count = pread(messages_, messages.data(), messages.size(), 0);
  messages.resize(count > 0 ? static_cast<size_t>(count) : 0);
  while (!messages.empty() && messages.back() == '\n') messages.pop_back();
  // Keeps the first line of ffmpeg's messages, which names the cause.
  throw Error(
      ErrorCode::kInternal, video_.string(),
      "ffmpeg: " + (messages.empty() ? "ended early" : messages.substr(0, messages.find('\n'))));
}

}  // namespace choreo
