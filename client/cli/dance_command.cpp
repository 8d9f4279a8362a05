#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "client/cli/choreography.h"
#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/key_file.h"
#include "client/cli/music.h"
#include "client/cli/report.h"
#include "model/core/progress.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

struct DanceOptions {
  ServerOptions server;
  std::string song;
  std::vector<std::string> keys;
  std::optional<double> seconds;
  std::optional<uint64_t> seed;
  std::optional<double> temperature;
  double fps = 0;
  std::string model;
  std::string out;
  std::string report;
};

std::filesystem::path OutputPath(const DanceOptions& options) {
  const std::filesystem::path path =
      options.out.empty() ? std::filesystem::path(options.song).replace_extension(".npz")
                          : std::filesystem::path(options.out);
  // Better now than after the dance.
  RequireMotionFile(path);
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder))
    throw Error(ErrorCode::kNotFound, "--out", "no folder " + folder.string());
  return path;
}

std::vector<client::KeyPose> ChooseKeys(const DanceOptions& options, const Music& music,
                                        double seconds, const Skeleton& skeleton) {
  if (options.keys.empty()) {
    return ComposeKeys({.seconds = seconds, .beats = music.beats, .seed = options.seed.value_or(0)},
                       PoseLibrary());
  }
  std::vector<client::KeyPose> keys;
  for (const std::string& source : options.keys) {
    auto more = ReadKeys(source, skeleton);
    std::move(more.begin(), more.end(), std::back_inserter(keys));
  }
  return keys;
}

/// What is promised of a dance: every key is in it, hit to 1 mm.
void CheckKeys(const std::vector<client::KeyPose>& keys, const client::Report& report) {
  constexpr double kPromise = 0.001;  // metres
  for (const client::KeyPose& key : keys) {
    const auto reached =
        std::find_if(report.keys.begin(), report.keys.end(),
                     [&](const client::KeyReached& candidate) { return candidate.id == key.id; });
    if (reached == report.keys.end()) {
      throw Error(ErrorCode::kInternal, key.id, "the dance has no such key pose");
    }
    if (!(reached->final_error_m <= kPromise)) {
      throw Error(
          ErrorCode::kInternal, key.id,
          "was missed by " + std::to_string(1000 * reached->final_error_m) + " mm, more than 1 mm");
    }
  }
}

/// Shows messages while they come.
class Display {
 public:
  Display(int64_t frames, double model_fps) : frames_(frames), model_fps_(model_fps) {}

  void operator()(const client::Message& message) {
    if (const auto* header = std::get_if<client::Header>(&message)) {
      bar_ = std::make_unique<ProgressBar>(
          "dancing",
          1 + static_cast<int64_t>(static_cast<double>(frames_ - 1) * header->fps / model_fps_));
    } else if (const auto* block = std::get_if<client::FrameBlock>(&message)) {
      bar_->Advance(static_cast<int64_t>(block->poses.size()));
    } else if (const auto* key = std::get_if<client::KeyReached>(&message)) {
      bar_->Advance(0, key->id);
    } else if (const auto* warning = std::get_if<client::Warning>(&message)) {
      bar_->Print("warning: frame " + std::to_string(warning->frame) + ": " + warning->message);
    } else if (const auto* rejected = std::get_if<client::KeyRejected>(&message)) {
      bar_->Print("warning: key " + rejected->id + " was refused: " + rejected->reason);
    } else if (const auto* resumed = std::get_if<client::Resumed>(&message)) {
      bar_->Print("lost the server (" + resumed->reason + "); " + resumed->address + " goes on" +
                  (resumed->exact ? "" : ", with another model or build"));
    } else if (std::holds_alternative<client::Report>(message)) {
      bar_->Finish();
    }
  }

 private:
  int64_t frames_;
  double model_fps_;
  std::unique_ptr<ProgressBar> bar_;
};

void Run(const DanceOptions& options) {
  const std::filesystem::path out = OutputPath(options);
  const Music music = ReadMusic(options.song);
  const double seconds =
      std::min(options.seconds.value_or(music.audio.seconds()), music.audio.seconds());

  const Connection connection(options.server);
  const client::ModelDescription& model = connection.model(options.model);
  const auto frames = static_cast<int64_t>(std::llround(seconds * model.fps));
  std::vector<client::KeyPose> keys = ChooseKeys(options, music, seconds, model.skeleton);
  std::stable_sort(keys.begin(), keys.end(),
                   [&](const client::KeyPose& a, const client::KeyPose& b) {
                     const auto frame = [&](const client::KeyPose& key) {
                       return key.frame.value_or(std::llround(key.time_s * model.fps));
                     };
                     return frame(a) < frame(b);
                   });

  client::DanceConfig config;
  config.model = options.model;
  config.fps = options.fps;
  config.seed = options.seed.value_or(0);
  config.temperature = options.temperature;
  config.frames = frames;
  std::copy_if(music.beats.begin(), music.beats.end(), std::back_inserter(config.music_beats),
               [&](double beat) { return beat < seconds; });
  Display display(frames, model.fps);
  const client::DanceResult dance = connection.client().Dance(
      config, keys, AudioFor(music, seconds), [&](const auto& message) { display(message); });

  WriteMotion(out, dance.header.skeleton, dance.motion, &dance.contacts);
  if (!options.report.empty()) WriteText(options.report, ReportJson(dance.header, dance.report));
  std::cout << ReportText(dance.header, dance.report) << out.string() << std::endl;
  CheckKeys(keys, dance.report);
}

}  // namespace

void AddDanceCommand(CLI::App& program) {
  auto options = std::make_shared<DanceOptions>();
  CLI::App* command =
      program.add_subcommand("dance",
                             "Dance to a song, through key poses, and write the motion.\n"
                             "Alone, as in `choreo dance song.ogg`, it takes key poses of the "
                             "library that ships, on beats of the music.");
  command->add_option("song", options->song, "WAV, FLAC, Ogg or MP3 file.")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("-k,--keyframes", options->keys,
                      "Key poses: a JSON key file, or poses of a motion file, as in "
                      "walk.bvh@1.2,3.4 (at these seconds) or walk.bvh@1.2=4 "
                      "(the pose at 1.2 s at second 4 of the dance). May be given more than once.");
  command->add_option("-s,--seconds", options->seconds, "Length of the dance; default: the song's.")
      ->check(CLI::PositiveNumber);
  command->add_option("--seed", options->seed, "Same seed, same dance. Default: 0.");
  command->add_option("--temperature", options->temperature,
                      "Variety, 0 (calm) to 2; default: the model's.");
  command->add_option("--fps", options->fps,
                      "Frames a second that are written, 1 to 120; default: the model's.");
  command->add_option("-m,--model", options->model,
                      "Model of the server to dance with; default: its first.");
  command->add_option("-o,--out", options->out,
                      "FILE.npz, FILE.bvh or FILE.glb to write; default: beside the song.");
  command->add_option("--report", options->report, "JSON file to write the report to.");
  command->add_flag(
      "--allow-inexact-resume", options->server.allow_inexact_resume,
      "If the server is lost and only one of another model or build is left, go on with that.");
  options->server.AddTo(*command);
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
