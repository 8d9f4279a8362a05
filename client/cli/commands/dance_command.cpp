#include <algorithm>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>

#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/key_file.h"
#include "client/authoring/project/dancers.h"
#include "client/authoring/project/project_file.h"
#include "client/cli/commands/commands.h"
#include "client/cli/dance/dance_performance.h"
#include "client/cli/dance/stage_dance.h"
#include "client/cli/options/authoring_options.h"
#include "client/cli/options/bvh_options.h"
#include "client/cli/options/interruption.h"
#include "client/cli/options/options.h"
#include "client/cli/options/output_file.h"
#include "client/cli/report/report.h"
#include "model/core/files/atomic_file.h"
#include "model/core/limits.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

/// Fills in settings that the command line leaves open from the project.
void FillFromProject(DanceOptions* options) {
  const authoring::Project project = authoring::ReadProject(options->project);
  options->keys = {project.has_keys ? options->project : authoring::kNoKeys};
  if (options->song.empty() && !project.song.empty()) {
    if (!std::filesystem::is_regular_file(project.song)) {
      throw Error(
          ErrorCode::kNotFound, options->project + ":song",
          project.song + " is not there; name it: choreo dance SONG --project " + options->project);
    }
    options->song = project.song;
  }
  // Uses the beats of the project only with the project's own song, unless others are requested.
  const auto file_of = [](const std::string& song) {
    return std::filesystem::path(song).filename();
  };
  authoring::RequireSong(project, options->song, options->project);
  const bool others = options->beats.beats || options->beats.hint.tempo_bpm;
  if (!others && file_of(options->song) == file_of(project.song)) {
    for (const auto& [beats, of_dance] : {std::pair(&project.beats, &options->project_beats),
                                          {&project.downbeats, &options->project_downbeats},
                                          {&project.ones, &options->project_ones}}) {
      for (const double beat : *beats)
        if (beat >= options->song_start_s) of_dance->push_back(beat - options->song_start_s);
    }
    if (!project.beats.empty()) {
      authoring::RequireLeft(options->project + ":beats", !options->project_beats.empty(),
                             options->song_start_s);
    }
    authoring::ChangeBeats(options->beats, options->song_start_s, &options->project_beats,
                           &options->project_downbeats);
    if (options->beats != authoring::BeatOptions())
      options->project_ones = options->project_downbeats;
  }
  if (!options->seconds) options->seconds = project.seconds;
  if (!options->seed) options->seed = project.seed;
  if (options->style.empty() && !project.style.empty())
    options->style_name = options->project + ":style";
  options->FillFrom(project);
  if (options->dancers.empty() && project.has_dancers) options->dancers = options->project;
  options->controls.Follow(project.controls);
}

std::filesystem::path OutputPath(const DanceOptions& options) {
  std::filesystem::path path = options.out;
  if (path.empty()) path = std::filesystem::path(options.song).replace_extension(".npz");
  if (path == ".npz" || path == "-.npz") path = "dance.npz";
  // Fails before the dance, not after it.
  RequireWrittenMotionFile(path);
  options.bvh.Check(path);
  return path;
}

/// Refuses outputs that cannot or must not be written.
void CheckFiles(const DanceOptions& options, const std::vector<std::filesystem::path>& outs,
                const std::vector<std::filesystem::path>& reports) {
  std::vector<NamedFile> outputs;
  for (const std::filesystem::path& out : outs) {
    if (options.no_clobber && std::filesystem::exists(out))
      throw InvalidArgument("--no-clobber", out.string() + " is there already");
    outputs.push_back({"--out", out});
  }
  for (const std::filesystem::path& report : reports) outputs.push_back({"--report", report});
  std::vector<NamedFile> inputs = FilesOf(options.controls);
  inputs.push_back({"song", options.song});
  for (const std::string& keys : authoring::KeySources(options.keys))
    inputs.push_back(
        {options.project.empty() ? "--keyframes" : "--project", authoring::FileOf(keys)});
  inputs.push_back({"--dancers", options.dancers});
  if (!options.end.empty()) inputs.push_back({"--end", authoring::FileOf(options.end)});
  RequireOutputs(outputs, inputs);
}

void Run(const DanceOptions& options) {
  const std::filesystem::path out = OutputPath(options);
  std::optional<authoring::Dancers> stage;
  if (!options.dancers.empty()) stage = authoring::ReadDancers(options.dancers);
  if (stage && !options.vmc.empty())
    throw InvalidArgument("--vmc", "shows one dancer, and " + options.dancers + " has several");
  if (stage) {
    CheckFiles(options, OutputsOf(*stage, out), ReportsOf(*stage, options.report));
  } else {
    CheckFiles(options, {out}, {options.report});
  }
  std::optional<authoring::Music> music;
  authoring::RequireSong(options.beats, options.song);
  if (!options.song.empty()) {
    music = authoring::ReadMusic(options.song,
                                 options.seconds.value_or(std::numeric_limits<double>::infinity()),
                                 options.song_start_s, options.beats);
    authoring::NoteBehind(options.project + ":beats", options.project_beats, options.song_start_s,
                          authoring::HeardSeconds(*music));
  }
  // Only our own server's default model is known to have SMPL's skeleton.
  if (options.server.addresses.empty() && options.model.empty()) CheckKeyFiles(options, music);
  std::optional<Connection> connection(std::in_place, options.server, options.model);
  const Interruption interruption;
  if (stage) return DanceTogether(options, *stage, music, *connection, out);
  std::optional<VmcShow> show;
  const auto [dance, written] = Perform(Plan(options, music, *connection), *connection, out, &show);
  // Nothing answers the server's pings while the dance is shown.
  connection.reset();
  options.bvh.Write(out, dance.header.skeleton, dance.motion, dance.contacts);
  if (!options.report.empty()) WriteFile(options.report, ReportJson(written));
  std::cout << ReportText(written) << FaultsText(written.faults, out) << out.string() << std::endl;
  while (show && !show->Over()) Interruption::Check();
  CheckKeys(written);
}

}  // namespace

void AddDanceCommand(CLI::App& program) {
  auto options = std::make_shared<DanceOptions>();
  CLI::App* command = program.add_subcommand(
      "dance",
      "Dance to a song, through key poses, and write the motion.\nAlone, as in `choreo dance "
      "song.ogg`, it uses key poses of the library, on beats of the music.");
  command
      ->add_option("song", options->song,
                   "WAV, FLAC, Ogg or MP3 file, or - for standard input; with ffmpeg installed, "
                   "any file that it reads. Without a song the dance has no music.")
      ->check(SongFile());
  AddBeatOptions(*command, &options->beats);
  AddRepeated(
      *command, "-k,--keyframes", options->keys,
      "Key poses: a JSON key file, one key of it (keys.json@ID), or poses of a motion file: "
      "walk.bvh@1.2,3.4 (at these seconds) or walk.bvh@1.2=4 (the pose at 1.2 s, at second 4 of "
      "the dance; =9c: on count 9 of the song, whose first downbeat is 1). Repeatable. none: no "
      "keys. `choreo analyze SONG --suggest-keys N` suggests times that suit the song.");
  command->add_option(
      "--end", options->end,
      "A pose to end in: of the library (bow, stand, ...), or as in --keyframes. The dancer "
      "reaches it on the last beat that leaves a second, and holds it to the end. Keys in the way "
      "are removed. A pose of the library faces the audience, or as --dancers turns each dancer.");
  AddAllowBends(*command, options->allow_bends);
  command
      ->add_option("--project", options->project,
                   "A project of `choreo studio`: its keys, path, seed, style, velocity factors, "
                   "dancers, music, and the song beside it. Other options override it.")
      ->check(CLI::ExistingFile)
      ->excludes("--keyframes");
  command
      ->add_option("-s,--seconds", options->seconds,
                   "Length of the dance, at most the song's. Default: the song's, or else up to "
                   "the last key pose and point of the path.")
      ->check(AboveZero());
  AddSongStart(*command, options->song_start_s);
  AddSeed(*command, options->seed,
          "Same seed, same dance. It also chooses the key poses of the library. Default: 0.");
  AddManner(*command, options.get());
  command->add_option("--fps", options->fps, "Frames a second to write. Default: the model's.")
      ->check(NumberFrom(kMinOutputFps, kMaxOutputFps));
  AddControlOptions(*command, &options->controls);
  AddModel(*command, options->model);
  command
      ->add_option("--dancers", options->dancers,
                   "JSON file of several dancers on one stage: their places, facings, delays and "
                   "own settings (docs/dancers.md). --out then means one file each, FILE.ID.npz, "
                   "or one .glb with all of them.")
      ->check(CLI::ExistingFile);
  command->add_option("-o,--out", options->out,
                      "FILE.npz, FILE.bvh, FILE.glb or FILE.vrma to write. Default: beside the "
                      "song, or dance.npz. An existing file is replaced.");
  command->add_option("--report", options->report, "JSON file to write the report to.");
  options->bvh.AddTo(*command);
  AddVmc(*command, options->vmc);
  CLI::Option* vmc = command->get_option("--vmc")->excludes("--dancers");
  vmc->description(vmc->get_description() + " The file of --out is written, too.");
  command->add_flag("--no-clobber", options->no_clobber, "Do not replace an existing motion file.");
  options->server.AddInexactResume(*command);
  options->server.AddTo(*command);
  command->callback([options, command] {
    if (!options->project.empty()) FillFromProject(options.get());
    CheckSongStart(*command, options->song);
    const bool keys = !options->keys.empty() && !authoring::IsNoKeys(options->keys);
    if (options->song.empty() && !options->seconds && !keys &&
        !options->controls.IsOption(kRootPath)) {
      throw CLI::RequiredError("A song, or else --keyframes, --path or --seconds");
    }
    Run(*options);
  });
}

}  // namespace choreo::cli
