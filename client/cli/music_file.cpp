#include "client/cli/music_file.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "model/core/error.h"

namespace choreo::cli {
namespace {

/// A file in memory that ends with its owner.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("song", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw Error(ErrorCode::kInternal, "", "no memory for a song");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// Whether ffmpeg is there and could write `path` as WAV into `wav`.
bool ConvertByFfmpeg(const std::filesystem::path& path, const MemoryFile& wav) {
  const std::string input = "file:" + path.string();  // a name, whatever it looks like
  std::vector<std::string> words{"ffmpeg", "-loglevel", "error", "-nostdin", "-i",        input,
                                 "-vn",    "-f",        "wav",   "-c:a",     "pcm_f32le", "pipe:1"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, wav.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int failed = posix_spawnp(&process, "ffmpeg", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return false;
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::optional<DecodedAudio> DecodeByFfmpeg(const std::filesystem::path& path, double seconds,
                                           double start) {
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  const MemoryFile wav;
  if (!ConvertByFfmpeg(path, wav)) return std::nullopt;
  try {
    DecodedAudio audio = DecodeAudioFile(wav.path(), seconds, start);
    // Into a pipe it can't write the length.
    audio.notes = {"read by ffmpeg, as it is not " + std::string(kSoundFormats)};
    return audio;
  } catch (const Error& error) {
    throw error.Of(path.string());
  }
}

}  // namespace

DecodedAudio DecodeSong(const std::filesystem::path& path, double seconds, double start) {
  std::optional<DecodedAudio> audio;
  try {
    audio = DecodeAudioFile(path, seconds, start);
  } catch (const Error& error) {
    // The refusal names the command; where it can be had, it is had.
    if (error.code() != ErrorCode::kInvalidArgument ||
        std::string_view(error.what()).find(kAskFfmpeg) == std::string_view::npos)
      throw;
    audio = DecodeByFfmpeg(path, seconds, start);
    if (!audio) throw;
  }
  for (const std::string& note : audio->notes)
    std::cerr << "note: " << path.string() << ": " << note << '\n';
  return *std::move(audio);
}

CLI::Validator SongFile() {
  CLI::Validator validator(
      [](std::string& name) { return name == "-" ? std::string() : CLI::ExistingFile(name); },
      "FILE", "song");
  return validator;
}

}  // namespace choreo::cli
