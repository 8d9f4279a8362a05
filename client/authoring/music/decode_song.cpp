#include "client/authoring/music/decode_song.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "client/authoring/notes/notes.h"
#include "model/core/error.h"
#include "model/core/text/printable.h"

namespace choreo::authoring {
namespace {

/// A file in memory, freed with its owner.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("choreo", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw Error(ErrorCode::kInternal, "", "no memory for a song");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }
  void Clear() const {
    if (ftruncate(descriptor_, 0) != 0 || lseek(descriptor_, 0, SEEK_SET) != 0)
      throw Error(ErrorCode::kInternal, "", "no memory for a song");
  }
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// Has ffmpeg convert `path` to WAV in `wav`. Writes its messages to `log`. Returns false if there
/// is no ffmpeg or it fails.
bool ConvertByFfmpeg(const std::filesystem::path& path, const std::string& filter,
                     const MemoryFile& wav, const MemoryFile& log) {
  const std::string input = "file:" + path.string();  // so that ffmpeg reads no URL or option
  std::vector<std::string> words{"ffmpeg",     "-hide_banner", "-nostats",  "-loglevel",
                                 "level+info", "-nostdin",     "-i",        input,
                                 "-vn",        "-af",          filter,      "-f",
                                 "wav",        "-c:a",         "pcm_f32le", "pipe:1"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, wav.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, log.descriptor(), STDERR_FILENO);
  pid_t process = 0;
  const int failed = posix_spawnp(&process, "ffmpeg", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return false;
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// ffmpeg's description of its input.
struct FfmpegLog {
  int tracks = 0;          ///< of audio
  bool restarts = false;   ///< whether its timestamps start again
  std::string error = {};  ///< the first one, or empty
};

FfmpegLog ParseLog(const MemoryFile& log) {
  std::ifstream lines(log.path());
  FfmpegLog report;
  bool of_input = true;
  for (std::string line; std::getline(lines, line);) {
    const auto has = [&](const char* words) { return line.find(words) != std::string::npos; };
    of_input = of_input && !has("] Output #");
    report.restarts = report.restarts || has("Non-monoto");
    if (of_input && has("Stream #0:") && has(": Audio: ")) ++report.tracks;
    for (const std::string level : {"[error] ", "[fatal] "}) {
      if (report.error.empty() && has(level.c_str()))
        report.error = Printable(line.substr(line.find(level) + level.size()));
    }
  }
  return report;
}

std::optional<DecodedAudio> DecodeByFfmpeg(const std::filesystem::path& path, double seconds,
                                           double start, double more) {
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  const MemoryFile wav, log;
  // Starts at the container's second 0, as players do, even if the sound begins later.
  bool converted = ConvertByFfmpeg(path, "aresample=async=1:first_pts=0", wav, log);
  FfmpegLog report = ParseLog(log);
  if (converted && report.restarts) {
    // The file's rate or channels change, so ffmpeg started again at second 0. Converts again
    // without timestamps, as for a station's stream, which has none.
    wav.Clear();
    log.Clear();
    converted = ConvertByFfmpeg(path, "anull", wav, log);
    report = ParseLog(log);
  }
  if (!converted && report.error.empty()) return std::nullopt;
  if (!converted) {
    throw InvalidArgument(path.string(),
                          std::string("not ") + kSoundFormats + " audio, and ffmpeg " +
                              (report.tracks > 0 ? "fails: " : "finds no sound in it: ") +
                              report.error);
  }
  try {
    DecodedAudio audio = DecodeAudioFile(wav.path(), seconds, start, more);
    // ffmpeg cannot write the WAV's length into a pipe.
    audio.notes = {"read by ffmpeg"};
    if (!report.error.empty()) {
      audio.notes.push_back("ffmpeg reports damage, so only a part may have been read: " +
                            report.error);
    }
    if (report.tracks > 1) {
      audio.notes.push_back("has " + std::to_string(report.tracks) +
                            " sound tracks, of which ffmpeg chose one; `ffmpeg -i FILE -map 0:a:1 "
                            "song.wav` takes the second");
    }
    return audio;
  } catch (const Error& error) {
    throw error.Of(path.string());
  }
}

}  // namespace

DecodedAudio DecodeSong(const std::filesystem::path& path, double seconds, double start,
                        double more) {
  std::optional<DecodedAudio> audio;
  if (std::error_code none;
      std::filesystem::is_regular_file(path, none) && std::filesystem::file_size(path, none) == 0)
    throw InvalidArgument(path.string(), "is empty");
  try {
    audio = DecodeAudioFile(path, seconds, start, more);
  } catch (const Error& error) {
    if (error.remedy() != Remedy::kConvert) throw;
    audio = DecodeByFfmpeg(path, seconds, start, more);
    if (!audio) throw;
  }
  for (const std::string& note : audio->notes) Note("note: " + path.string() + ": " + note);
  return *std::move(audio);
}

}  // namespace choreo::authoring
