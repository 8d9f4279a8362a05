#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>

#include "client/authoring/controls/written_controls.h"
#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_source.h"
#include "client/authoring/music/music.h"
#include "client/cli/commands/commands.h"
#include "client/cli/options/authoring_options.h"
#include "client/cli/options/connection.h"
#include "client/cli/options/options.h"
#include "client/cli/options/output_file.h"
#include "client/cli/report/report.h"
#include "client/edit.h"
#include "model/core/files/atomic_file.h"
#include "model/core/grid.h"
#include "model/core/limits.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

struct TransitionOptions : DanceManner {
  ServerOptions server;
  std::string from;
  std::string to;
  int frames = kTypicalFrames;
  std::string song;
  authoring::BeatOptions beats;
  std::string at = "0";
  int candidates = 1;
  std::string rank_by = "quality";
  std::optional<double> hit;
  std::string hands;
  std::optional<uint64_t> seed;
  std::string model;
  authoring::WrittenControls controls;
  std::string out;
  std::string report;
};

/// `out` for the best candidate; FILE.2, FILE.3 and so on for the others.
std::filesystem::path CandidatePath(const std::filesystem::path& out, size_t rank) {
  if (rank == 0) return out;
  std::filesystem::path path = out;
  return path.replace_filename(out.stem().string() + "." + std::to_string(rank + 1) +
                               out.extension().string());
}

client::TransitionResult Generate(const client::Client& client,
                                  const client::TransitionRequest& request,
                                  const authoring::WrittenControls& controls) {
  try {
    return client.GenerateTransition(request);
  } catch (const Error& error) {
    throw controls.InTermsOf(error);
  }
}

// Throws if --at is given without the options that it affects.
void CheckAt(const CLI::App& command, const TransitionOptions& options) {
  const auto is_absent = [](const NamedFile& file) { return file.path.empty(); };
  if (command.count("--at") > 0 && options.song.empty() &&
      std::ranges::all_of(FilesOf(options.controls), is_absent)) {
    throw CLI::ValidationError("--at", "needs --song, --path or a file for --velocity");
  }
}

void Run(const TransitionOptions& options) {
  RequireWrittenMotionFile(options.out);
  std::vector<NamedFile> outputs = {{"--report", options.report}};
  for (size_t rank = 0; rank < static_cast<size_t>(options.candidates); ++rank)
    outputs.push_back({"--out", CandidatePath(options.out, rank)});
  std::vector<NamedFile> inputs = FilesOf(options.controls);
  inputs.push_back({"--from", authoring::FileOf(options.from)});
  inputs.push_back({"--to", authoring::FileOf(options.to)});
  inputs.push_back({"--song", options.song});
  if (!options.beats.FindsThem()) inputs.push_back({"--beats", *options.beats.beats});
  RequireOutputs(outputs, inputs);
  authoring::RequireSong(options.beats, options.song);
  const Connection connection(options.server, options.model);
  const client::ModelDescription& model = connection.model(options.model);

  if (options.frames > model.max_transition_frames) {
    throw InvalidArgument("--frames", std::to_string(options.frames) + " is not in [1, " +
                                          std::to_string(model.max_transition_frames) +
                                          "], what the model \"" + model.name + "\" can make");
  }
  NoteStyle(model, options.style);
  NoteDeterministic(model, {{"--seed", options.seed.has_value()},
                            {"--temperature", options.temperature.value_or(0) != 0},
                            {"--candidates", options.candidates > 1}});
  client::TransitionRequest request;
  request.config.model = options.model;
  request.config.seed = options.seed.value_or(0);
  request.config.manner = options;
  const authoring::WrittenTime at = authoring::ParseTime(options.at, "--at");
  const double seconds = options.frames / model.fps;
  std::optional<authoring::Music> music;
  authoring::Counts counts;
  if (!options.song.empty()) {
    constexpr double kAll = std::numeric_limits<double>::infinity();
    music = authoring::ReadMusic(options.song, at.counts ? kAll : at.amount + seconds, 0,
                                 options.beats);
    counts = authoring::CountsOf(*music);
  }
  const double at_s = at.In(counts, "--at");
  request.config.controls = options.controls.Read(model, connection.server(), counts);
  request.config.first_frame = std::llround(at_s * model.fps);
  options.controls.RequireBegun(request.config.controls,
                                {request.config.first_frame + options.frames, model.fps});
  request.config.history = {authoring::ReadPose(options.from, model.skeleton).key.pose};
  request.frames = options.frames;
  // A deterministic model's candidates would all be equal.
  request.candidates = model.deterministic ? 1 : options.candidates;
  if (options.rank_by == "likelihood") request.rank_by = client::RankBy::kLikelihood;
  const authoring::NamedPose to = authoring::ReadPose(options.to, model.skeleton);
  client::KeyPose target = to.key;
  target.id = "target";  // as the report calls it
  // The path sets the place of a library pose.
  if (options.controls.IsOption(kRootPath) && !to.has_place) target.mask.root_position = false;
  if (options.hit) target.hit = options.hit;
  if (!options.hands.empty()) target.hands = FindHandPose(options.hands);
  request.target = target;
  if (music) {
    const double end_s = at_s + seconds;
    const client::Audio song = authoring::AudioFor(music->audio, end_s);
    if (at_s >= authoring::Seconds(song)) {
      throw InvalidArgument("--at", InFull(at_s) + " s is after the song's end at " +
                                        InFull(authoring::Seconds(song)) + " s");
    }
    client::SetMusic(song, model, request.config.first_frame, &request);
    authoring::FillInMusic(*music, end_s, &request.config.known);
  }
  const client::TransitionResult result = Generate(connection.client(), request, options.controls);
  ShowWarnings(result.warnings, {model.fps});

  for (size_t rank = 0; rank < result.candidates.size(); ++rank) {
    const std::filesystem::path path = CandidatePath(options.out, rank);
    const client::TransitionCandidate& candidate = result.candidates[rank];
    WriteMotion(path, result.header.skeleton, candidate.motion, &candidate.contacts);
    WrittenDance written = Examine(result.header, candidate.report, candidate.motion, {target});
    written.warnings = result.warnings;
    written.settings = {{options}, result.header.model, result.header.seed};
    written.settings.song = options.song == "-" ? "" : options.song;
    written.settings.song_start_s = at_s;
    std::cout << ReportText(written) << path.string() << std::endl;
    if (rank == 0 && !options.report.empty()) WriteFile(options.report, ReportJson(written));
    CheckKeys(written);
  }
}

}  // namespace

void AddTransitionCommand(CLI::App& program) {
  auto options = std::make_shared<TransitionOptions>();
  CLI::App* command =
      program.add_subcommand("transition", "Move from one pose to another, with or without music.");
  const std::string pose =
      "a pose of the library (contrapposto, ...), a key file, or MOTION@SECOND.";
  command->add_option("--from", options->from, "Where to begin: " + pose)->required();
  command->add_option("--to", options->to, "Where to end: " + pose)->required();
  command
      ->add_option("-n,--frames", options->frames,
                   "Length in frames of the model, at most its longest transition (`choreo info`).")
      ->check(WholeNumberFrom(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  command->add_option("--song", options->song, "Music to move to.")->check(SongFile());
  AddBeatOptions(*command, &options->beats);
  command
      ->add_option("--at", options->at,
                   "TIME of the song, path and factors at which the transition begins: a second, "
                   "or a count (9c; the first downbeat is 1c).")
      ->check(TimeOrCount())
      ->capture_default_str();
  command
      ->add_option(
          "--candidates", options->candidates,
          "Number of alternatives. The best is FILE, the others are FILE.2.npz and so on. " +
              kOfChance)
      ->check(WholeNumberFrom(1, kMaxCandidates))
      ->capture_default_str();
  command
      ->add_option("--rank-by", options->rank_by,
                   "Which alternative is the best, by quality (steering, support, skating) or by "
                   "likelihood (if the model has one, see `choreo info`).")
      ->check(OneOf({"quality", "likelihood"}))
      ->capture_default_str();
  AddHit(*command, options->hit, "the end is");
  AddHands(*command, options->hands,
           "Hands at the end, for characters with fingers (choreo convert --report)");
  AddSeed(*command, options->seed, "Same seed, same motion. Default: 0. " + kOfChance);
  AddManner(*command, options.get());
  AddControlOptions(*command, &options->controls);
  AddModel(*command, options->model);
  command->add_option("-o,--out", options->out, "FILE.npz, FILE.bvh or FILE.glb to write.")
      ->required();
  command->add_option("--report", options->report, "JSON file to write the best one's report to.");
  options->server.AddTo(*command);
  command->callback([options, command] {
    CheckAt(*command, *options);
    Run(*options);
  });
}

}  // namespace choreo::cli
