#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>

#include "client/cli/bvh_options.h"
#include "client/cli/choreography.h"
#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/control_options.h"
#include "client/cli/dance_display.h"
#include "client/cli/dance_keys.h"
#include "client/cli/interruption.h"
#include "client/cli/json_fields.h"
#include "client/cli/key_faults.h"
#include "client/cli/key_file.h"
#include "client/cli/music.h"
#include "client/cli/options.h"
#include "client/cli/output_file.h"
#include "client/cli/project_file.h"
#include "client/cli/report.h"
#include "client/cli/vmc_show.h"
#include "model/core/atomic_file.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

struct DanceOptions {
  ServerOptions server;
  std::string song;
  BeatOptions beats;
  std::vector<std::string> keys;
  std::string project;
  std::vector<double> project_beats;
  std::optional<double> seconds;
  double song_start_s = 0;
  std::optional<uint64_t> seed;
  std::optional<double> temperature;
  std::optional<double> music_dynamics;
  std::optional<double> variation;
  std::string style;
  std::string style_name = "--style";  // where it is said
  double fps = 0;
  ControlOptions controls;
  std::string model;
  std::string out;
  std::string report;
  std::string vmc;
  BvhOptions bvh;
  bool no_clobber = false;
  bool allow_bends = false;
};

/// What the command line leaves open, the project says.
void TakeProject(DanceOptions* options) {
  const Project project = ReadProject(options->project);
  options->keys = {options->project};
  if (options->song.empty() && !project.song.empty()) {
    if (!std::filesystem::is_regular_file(project.song)) {
      throw Error(
          ErrorCode::kNotFound, options->project + ":song",
          project.song + " is not there; name it: choreo dance SONG --project " + options->project);
    }
    options->song = project.song;
  }
  // Of its song alone.
  const auto file_of = [](const std::string& song) {
    return std::filesystem::path(song).filename();
  };
  if (options->beats == BeatOptions() && file_of(options->song) == file_of(project.song)) {
    for (const double beat : project.beats) {
      if (beat >= options->song_start_s)
        options->project_beats.push_back(beat - options->song_start_s);
    }
  }
  if (!options->seconds) options->seconds = project.seconds;
  if (!options->seed) options->seed = project.seed;
  if (options->style.empty() && !project.style.empty()) {
    options->style = project.style;
    options->style_name = options->project + ":style";
  }
  if (!options->music_dynamics) options->music_dynamics = project.music_dynamics;
  if (!options->variation) options->variation = project.variation;
  options->controls.path_text = project.path;
  options->controls.path_text_name = options->project + ":path";
  // Of several sources the last that speaks of a part counts: those of the command line.
  std::vector<std::string>& velocities = options->controls.velocities;
  velocities.insert(velocities.begin(), project.velocities.begin(), project.velocities.end());
}

std::filesystem::path OutputPath(const DanceOptions& options) {
  std::filesystem::path path = options.out;
  if (path.empty()) path = std::filesystem::path(options.song).replace_extension(".npz");
  if (path == ".npz" || path == "-.npz") path = "dance.npz";
  // Better now than after the dance.
  RequireWrittenMotionFile(path);
  options.bvh.Check(path);
  if (options.no_clobber && std::filesystem::exists(path))
    throw InvalidArgument("--no-clobber", path.string() + " is there already");
  std::vector<NamedFile> inputs = options.controls.Files();
  inputs.push_back({"song", options.song});
  for (const std::string& keys : KeySources(options.keys))
    inputs.push_back({options.project.empty() ? "--keyframes" : "--project", FileOf(keys)});
  RequireOutputs({{"--out", path}, {"--report", options.report}}, inputs);
  return path;
}

/// Without a song: as long as the path and the keys need.
double ChooseSilentSeconds(const DanceOptions& options, const client::Controls& controls,
                           const client::ModelDescription& model) {
  if (options.seconds) return *options.seconds;
  int64_t last = controls.root_path ? controls.root_path->frames.back() : 0;
  for (const std::string& source : KeySources(options.keys)) {
    for (const client::KeyPose& key : ReadKeys(source, model.skeleton))
      last = std::max(last, FrameOf(key, model.fps));
  }
  return static_cast<double>(last + 1) / model.fps;
}

double ChooseSeconds(const DanceOptions& options, const Music& music) {
  const double song = music.audio.seconds();
  if (!options.seconds) return song;
  if (*options.seconds > song) {
    std::ostringstream message;
    message << "warning: --seconds " << *options.seconds << " is beyond the song, which ends at "
            << Rounded(song) << " s; the dance ends with it\n";
    std::cerr << message.str();
  }
  return std::min(*options.seconds, song);
}

DanceKeys ChooseKeys(const DanceOptions& options, const std::optional<Music>& music, double seconds,
                     const DanceLength& length, const client::ModelDescription& model) {
  if (SaysNoKeys(options.keys)) return {};
  if (!options.keys.empty()) {
    if (length.frames < 1) {
      std::ostringstream message;
      message << seconds << " s is shorter than a frame of the model, " << Rounded(1 / length.fps)
              << " s, the least";
      throw InvalidArgument("--seconds", message.str());
    }
    DanceKeys keys = ReadDanceKeys(options.keys, length, model.skeleton);
    if (!options.allow_bends) RefuseBends(keys, model.skeleton);
    return keys;
  }
  CompositionRequest request{.seconds = seconds, .seed = options.seed.value_or(0)};
  if (!options.seconds) request.named = music ? options.song : "--path";
  if (music) {
    request.beats = music->track.Seconds();
    request.passages = music->passages;
  }
  // Its dancers hardly dance where no key is ahead.
  if (model.deterministic) request.end_s = static_cast<double>(length.frames - 1) / length.fps;
  DanceKeys keys;
  keys.poses = ComposeKeys(request, PosesToDance(model.skeleton));
  for (size_t i = 0; i < keys.poses.size(); ++i) {
    keys.places.push_back("keyframes[" + std::to_string(i) + "]");
    // Where the dancer is then, the path says.
    if (!options.controls.path.empty()) keys.poses[i].mask.root_position = false;
  }
  return keys;
}

/// Dances. What came of a dance that was cut off, or interrupted, is written, too.
client::DanceResult Dance(const client::Client& client, const client::DanceConfig& config,
                          const DanceKeys& keys, const client::Audio& audio, double model_fps,
                          const DanceOptions& options, const std::filesystem::path& out,
                          VmcShow* show) {
  client::DanceResult dance;
  DanceDisplay display(*config.frames, model_fps);
  try {
    client.Dance(
        config, keys.poses, audio,
        [&](const client::Message& message) {
          Interruption::Check();
          display(message);
          if (show) show->Take(message);
        },
        &dance);
  } catch (const Error& error) {
    if (!dance.motion.frames.empty()) {
      const std::filesystem::path partial = PartialPath(out);
      options.bvh.Write(partial, dance.header.skeleton, dance.motion, dance.contacts);
      std::ostringstream message;
      message << "the dance was cut off; its first " << dance.motion.frames.size() << " frames ("
              << Rounded(static_cast<double>(dance.motion.frames.size()) / dance.motion.fps)
              << " s) are in " << partial.string() << '\n';
      std::cerr << message.str();
    }
    if (error.field() == "config.style") throw error.Of(options.style_name);
    throw InTermsOf(keys, options.controls.InTermsOf(error));
  }
  return dance;
}

void Run(const DanceOptions& options) {
  const std::filesystem::path out = OutputPath(options);
  std::optional<Music> music;
  if (options.song.empty() && options.beats != BeatOptions())
    throw InvalidArgument("--beats", "and other options of beats need a song");
  if (!options.song.empty()) {
    music =
        ReadMusic(options.song, options.seconds.value_or(std::numeric_limits<double>::infinity()),
                  options.song_start_s, options.beats);
  }

  const Connection connection(options.server, options.model);
  const client::ModelDescription& model = connection.model(options.model);
  // It chooses among the library's key poses, whatever the model.
  const bool is_seed_for_model = options.seed && !options.keys.empty();
  NoteDeterministic(model, {{"--seed", is_seed_for_model},
                            {"--temperature", options.temperature.value_or(0) != 0}});
  const client::Controls controls = options.controls.Read(model, connection.server());
  const double seconds =
      music ? ChooseSeconds(options, *music) : ChooseSilentSeconds(options, controls, model);
  if (music && !model.takes_music) {
    std::cerr << "note: the model \"" << model.name
              << "\" takes no music; the song gives the dance its length and its beats\n";
  }
  CheckInADance(std::round(seconds * model.fps) / model.fps, "--seconds");
  const DanceLength length{std::llround(seconds * model.fps), model.fps};
  const DanceKeys keys = ChooseKeys(options, music, seconds, length, model);
  options.controls.RequireBegun(controls, length);
  const std::vector<client::Warning> faults = KeyFaults(keys, model.fps, model.skeleton);
  ShowWarnings(faults);

  client::DanceConfig config;
  config.model = options.model;
  config.fps = options.fps;
  config.seed = options.seed.value_or(0);
  config.temperature = options.temperature;
  config.music_dynamics = options.music_dynamics;
  config.variation = options.variation;
  config.style = options.style;
  config.frames = length.frames;
  config.controls = controls;
  config.music_beats = options.project_beats;
  if (music) TellMusic(*music, seconds, &config);
  const client::Audio audio =
      music && model.takes_music ? AudioFor(music->audio, seconds) : client::Audio{};
  std::optional<VmcShow> show;
  if (!options.vmc.empty()) show.emplace(options.vmc, model.skeleton);
  const Interruption interruption;
  const client::DanceResult dance = Dance(connection.client(), config, keys, audio, model.fps,
                                          options, out, show ? &*show : nullptr);

  options.bvh.Write(out, dance.header.skeleton, dance.motion, dance.contacts);
  WrittenDance written = Examine(dance.header, dance.report, dance.motion, keys.poses);
  for (size_t i = 0; i < written.keys.size(); ++i) written.keys[i].holds = HeldKey(keys, i);
  written.warnings = faults;
  written.warnings.insert(written.warnings.end(), dance.warnings.begin(), dance.warnings.end());
  written.beat_hit_chance = BeatHitChance(config.music_beats, length.frames, model.fps);
  if (!options.report.empty()) WriteFile(options.report, ReportJson(written));
  std::cout << ReportText(written) << out.string() << std::endl;
  while (show && !show->Over()) Interruption::Check();
  CheckKeys(written);
}

}  // namespace

void AddDanceCommand(CLI::App& program) {
  auto options = std::make_shared<DanceOptions>();
  CLI::App* command =
      program.add_subcommand("dance",
                             "Dance to a song, through key poses, and write the motion.\n"
                             "Alone, as in `choreo dance song.ogg`, it takes key poses of the "
                             "library that ships, on beats of the music.");
  command
      ->add_option("song", options->song,
                   "WAV, FLAC, Ogg or MP3 file, or - for standard input; with ffmpeg installed, "
                   "whatever that reads. Without one the dance is silent.")
      ->check(SongFile());
  AddBeatOptions(*command, &options->beats);
  AddRepeated(*command, "-k,--keyframes", options->keys,
              "Key poses: a JSON key file, or one key of it (keys.json@ID), or poses of a motion "
              "file, as in walk.bvh@1.2,3.4 (at these seconds) or walk.bvh@1.2=4 (the pose at 1.2 "
              "s at second 4 of the dance). May be given more than once. none: no key at all. "
              "`choreo analyze SONG --suggest-keys N` names seconds that suit the song.");
  AddAllowBends(*command, options->allow_bends);
  command
      ->add_option("--project", options->project,
                   "A project that `choreo studio` saved: its keys, path, seed, style, liveliness, "
                   "music and the song beside it, as far as nothing else is said here.")
      ->check(CLI::ExistingFile)
      ->excludes("--keyframes");
  command
      ->add_option("-s,--seconds", options->seconds,
                   "Length of the dance, which ends with the song at the latest; default: the "
                   "song's, or else up to the last key pose and point of the path.")
      ->check(AboveZero());
  AddSongStart(*command, options->song_start_s);
  AddSeed(*command, options->seed,
          "Same seed, same dance; it also chooses among the library's key poses. Default: 0.");
  AddTemperature(*command, options->temperature);
  AddMusicDynamics(*command, options->music_dynamics);
  AddVariation(*command, options->variation);
  AddStyle(*command, options->style);
  command
      ->add_option("--fps", options->fps, "Frames a second that are written; default: the model's.")
      ->check(NumberFrom(kMinOutputFps, kMaxOutputFps));
  options->controls.AddTo(*command);
  AddModel(*command, options->model);
  command->add_option("-o,--out", options->out,
                      "FILE.npz, FILE.bvh or FILE.glb to write; default: beside the song, or "
                      "dance.npz. A file that is there is replaced.");
  command->add_option("--report", options->report, "JSON file to write the report to.");
  options->bvh.AddTo(*command);
  AddVmc(*command, options->vmc);
  command->add_flag("--no-clobber", options->no_clobber, "Replace no motion file that is there.");
  command->add_flag(
      "--allow-inexact-resume", options->server.allow_inexact_resume,
      "If the server is lost and only one of another model or build is left, go on with that.");
  options->server.AddTo(*command);
  command->callback([options, command] {
    if (!options->project.empty()) TakeProject(options.get());
    CheckSongStart(*command, options->song);
    const bool keys = !options->keys.empty() && !SaysNoKeys(options->keys);
    if (options->song.empty() && !options->seconds && !keys && options->controls.path.empty()) {
      throw CLI::RequiredError("A song, or else --keyframes, --path or --seconds");
    }
    Run(*options);
  });
}

}  // namespace choreo::cli
