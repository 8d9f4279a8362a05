#include <memory>

#include "client/authoring/fields/counts.h"
#include "client/authoring/keys/key_file.h"
#include "client/cli/commands/commands.h"
#include "client/cli/edit/edit_markers.h"
#include "client/cli/edit/edit_whole.h"
#include "client/cli/edit/edits.h"
#include "client/cli/options/authoring_options.h"
#include "client/cli/options/options.h"
#include "client/cli/options/output_file.h"
#include "client/cli/options/placing_options.h"
#include "client/cli/report/report.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

constexpr double kMaxStretch = 4;

/// Reports invalid times, and counts without a song, before a server is called or started.
void CheckTimes(const EditOptions& options) {
  for (const auto& [option, time] : TimesOf(options)) {
    const authoring::WrittenTime parsed = authoring::ParseTime(time, option);
    if (options.song.empty()) parsed.In({}, option);
  }
  for (const auto& [from, until] : options.retakes) {
    const auto [begin, end] =
        std::pair(authoring::ParseTime(from, "--retake"), authoring::ParseTime(until, "--retake"));
    if (begin.counts == end.counts && begin.amount >= end.amount)
      throw InvalidArgument("--retake", until + " is not after " + from);
  }
}

/// Throws for edits that need the report, which names the keys, if none is given.
void CheckReported(const EditOptions& options) {
  for (const auto& [option, given] : {std::pair("--move", !options.moves.empty()),
                                      {"--remove", !options.removed.empty()},
                                      {"--repeat", !options.repeats.empty()},
                                      {"--stretch", !options.stretches.empty()},
                                      {"--mirror-phrase", !options.mirrored.empty()}}) {
    if (given && options.report.empty())
      throw InvalidArgument(option, "needs --report, which names the keys");
  }
  for (const auto& [from, until, times] : options.stretches) {
    if (!(times >= 1 / kMaxStretch && times <= kMaxStretch) || times == 1) {
      throw InvalidArgument("--stretch", InFull(times) + " times, must be " +
                                             InFull(1 / kMaxStretch) + " to " +
                                             InFull(kMaxStretch) + ", and not 1");
    }
  }
}

/// Checks that the first key to change is in the report, before a server is called or started.
void CheckFirstKey(const EditOptions& options) {
  const bool removes = !options.removed.empty();
  if (!removes && options.moves.empty()) return;
  const std::string& id = removes ? options.removed.front() : options.moves.front().first;
  // Finding the key ID@COUNT requires the song's counts.
  if (!options.song.empty() && id.find('@') != std::string::npos) return;
  FindKey(options.known.keys, id, options.known.fps, removes ? "--remove" : "--move", {});
}

/// Refuses edits of a project other than of its markers.
void CheckMarkers(const EditOptions& options) {
  if (EditsKeys(options) || EditsWhole(options)) {
    throw InvalidArgument("dance", options.dance +
                                       " is a project: --mark and --unmark change it; choreo dance "
                                       "--project dances it");
  }
  if (options.marks.empty() && options.unmarked.empty())
    throw InvalidArgument("--mark", "is missing, and so is --unmark: nothing to change");
  for (const auto& [id, time] : options.marks) {
    if (id.empty()) throw InvalidArgument("--mark", "has an empty name");
    authoring::ParseTime(time, "--mark");
  }
  RequireExtension("--out", options.out, {".json"});
  RequireOutputs({{"--out", options.out}}, {{"dance", options.dance}});
}

void CheckOptions(const EditOptions& options) {
  if (!options.marks.empty() || !options.unmarked.empty())
    throw InvalidArgument("--mark", "goes with a project, and " + options.dance + " is none");
  const bool otherwise = options.changed != DanceChange::kNothing;
  if (!EditsKeys(options) && !EditsWhole(options) && otherwise && options.report.empty()) {
    throw InvalidArgument(
        "--report", "is missing: it names the keys, through which the whole dance is danced again");
  }
  if (!EditsKeys(options) && !EditsWhole(options) && !otherwise) {
    throw InvalidArgument(
        "--key",
        "is missing, and so are --move, --remove, --repeat, --stretch, --mirror-phrase, --retake, "
        "--end, --loop, --from, --until, --mirror and --join, and --seed, --style, --path, "
        "--velocity and options of beats, which change the whole dance: nothing to change");
  }
  if (EditsKeys(options) && EditsWhole(options)) {
    throw InvalidArgument("--key",
                          "and --move, --remove, --repeat, --stretch, --mirror-phrase, --retake, "
                          "--end, --loop go in a "
                          "command of their own, after --from, --until, --mirror, --join, which "
                          "change the whole dance");
  }
  CheckReported(options);
  CheckTimes(options);
  if (options.keys.size() != options.at.size()) {
    throw InvalidArgument("--at", std::to_string(options.at.size()) + " times for " +
                                      std::to_string(options.keys.size()) +
                                      " keys; each --key needs one");
  }
  if (!options.hold.empty() && options.keys.empty() && options.moves.empty())
    throw InvalidArgument("--hold", "goes with --key and --move");
  if (!options.hands.empty() && options.keys.empty() && options.moves.empty())
    throw InvalidArgument("--hands", "goes with --key and --move");
  if (options.placing.IsGiven() && options.keys.empty())
    throw InvalidArgument(options.placing.place ? "--place" : "--facing", "goes with --key");
  RequireWrittenMotionFile(options.out);
  std::vector<NamedFile> inputs = FilesOf(options.controls);
  inputs.push_back({"dance", options.dance});
  inputs.push_back({"--report", options.report});
  inputs.push_back({"--song", options.song});
  inputs.push_back({"--join", options.join});
  inputs.push_back({"--join-report", options.join_report});
  for (const std::string& key : options.keys) inputs.push_back({"--key", authoring::FileOf(key)});
  if (!options.end.empty()) inputs.push_back({"--end", authoring::FileOf(options.end)});
  RequireOutputs({{"--out", options.out}, {"--new-report", options.new_report}}, inputs);
  if (options.changed == DanceChange::kCounts && !EditsKeys(options) && !EditsWhole(options) &&
      options.new_report.empty())
    throw InvalidArgument("--new-report", "is missing: --downbeat alone changes only the report");
  if (options.report.empty() && !options.new_report.empty()) {
    throw InvalidArgument("--new-report", "needs --report, from which it is made");
  }
  if (!options.new_report.empty() && !options.join.empty() && options.join_report.empty()) {
    throw InvalidArgument("--join-report", "is missing: --new-report names both dances' keys");
  }
  CheckFirstKey(options);
}

void Run(const EditOptions& options) {
  if (IsProject(options)) {
    CheckMarkers(options);
    return EditMarkers(options);
  }
  CheckOptions(options);
  if (EditsWhole(options)) return EditWhole(options);
  const Connection connection(options.server, options.model);
  WorkingDance dance(options, connection);
  const auto second = [&](const char* option, const std::string& time) {
    return dance.times().Second(option, time);
  };
  CheckKeys(options, dance.times());
  try {
    for (const std::string& id : options.removed) RemoveKey(id, &dance);
    for (const auto& [id, time] : options.moves)
      MoveKey(options, id, second("--move", time), &dance);
    for (const auto& [from, until, times] : options.stretches)
      StretchPhrase(second("--stretch", from), second("--stretch", until), times, &dance);
    for (const auto& [from, until, later] : options.repeats)
      RepeatPhrase(second("--repeat", from), second("--repeat", until), later, &dance);
    for (const auto& [from, until] : options.mirrored)
      MirrorPhrase(second("--mirror-phrase", from), second("--mirror-phrase", until), &dance);
    for (size_t i = 0; i < options.keys.size(); ++i)
      SetKey(options, options.keys[i], second("--at", options.at[i]), &dance);
    if (!options.end.empty()) EndInPose(options, options.end, &dance);
    for (const auto& [from, until] : options.retakes)
      Retake(second("--retake", from), second("--retake", until), &dance);
    if (!EditsKeys(options)) DanceOtherwise(options, &dance);
    if (options.loop) CloseLoop(&dance);
  } catch (const Error& error) {
    throw options.controls.InTermsOf(error);
  }
  dance.Write();
}

}  // namespace

void AddEditCommand(CLI::App& program) {
  auto options = std::make_shared<EditOptions>();
  CLI::App* command = program.add_subcommand(
      "edit",
      "Change a finished dance: set, move, remove and repeat key poses, dance a part again, or "
      "close it to a loop; cut, mirror and join whole dances.\nOnly the two intervals around a key "
      "change; all other frames stay the same, bit for bit. An interval ends at the neighbouring "
      "key of --report if that is within 4 s, else after --around seconds. A key on the frame of "
      "another one replaces it, with a note. A TIME is in seconds, or in counts of --song: 1c is "
      "its first downbeat, 9c the 1 of the next eight, 9.5c half a beat later. Keys are first "
      "removed, then moved, stretched, repeated, mirrored and set; retakes come last. --seed, "
      "--style, --path, --velocity, --music-dynamics or --variation alone dance all of it again, "
      "through the same keys, as do other beats; --downbeat alone changes no frame. Whole "
      "dances are first cut, then mirrored, then joined.");
  command
      ->add_option("dance", options->dance,
                   MotionFileExtensions() + " file; a project with --mark and --unmark.")
      ->required()
      ->check(CLI::ExistingFile);
  AddRepeated(
      *command, "-k,--key", options->keys,
      "A key pose to set: a pose of the library (kick, ...), where the dancer is at that time; a "
      "key file with one pose; KEYS.json@ID; MOTION@SECOND; or a key of --report, whose pose is "
      "set where the dancer is. Repeatable; each needs its --at.");
  AddRepeated(*command, "--at", options->at,
              "TIME of the key in the dance: a second, or a count (9c).")
      ->check(TimeOrCount());
  command
      ->add_option("--move", options->moves,
                   "ID TIME: move a key of --report, with its hold, to this second or count of the "
                   "dance. Repeatable. If several keys have one name, ID@TIME means the nearest.")
      ->allow_extra_args(false);
  AddRepeated(*command, "--remove", options->removed,
              "ID: remove a key of --report. Repeatable. If several keys have one name, ID@TIME "
              "means the nearest.");
  command
      ->add_option(
          "--mark", options->marks,
          "NAME TIME: set a marker in a project, or move the marker of this name. Repeatable.")
      ->allow_extra_args(false);
  AddRepeated(
      *command, "--unmark", options->unmarked,
      "NAME: remove a marker from a project. If several have one name: NAME@SECOND. Repeatable.");
  command
      ->add_option("--hold", options->hold,
                   "Seconds or counts (2c) to hold the poses of --key and --move. Default: as the "
                   "key file or --report says, else no hold.")
      ->check(TimeOrCount());
  AddHit(*command, options->hit, "the poses of --key and --move are");
  AddHands(*command, options->hands,
           "Hands in the poses of --key and --move, for characters with fingers (choreo convert "
           "--report)");
  command
      ->add_option("--repeat", options->repeats,
                   "FROM UNTIL LATER: repeat the keys of --report from FROM on and before UNTIL, "
                   "LATER seconds or counts of --song (8c) later, moved and turned to where the "
                   "dancer is then. Keys in the way are removed. Repeatable.")
      ->allow_extra_args(false);
  command
      ->add_option("--stretch", options->stretches,
                   "FROM UNTIL TIMES: spread the keys of --report from FROM on and before UNTIL "
                   "over TIMES as many counts of --song: 2 is half time, 0.5 double time. They "
                   "keep their places on the floor. Keys in the way are removed. Repeatable.")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--mirror-phrase", options->mirrored,
          "FROM UNTIL: exchange left and right in the keys of --report from FROM on and before "
          "UNTIL, as seen from where the dancer stands and faces at the first of them. Repeatable.")
      ->allow_extra_args(false);
  command
      ->add_option("--retake", options->retakes,
                   "FROM UNTIL: dance this part again, through the same keys of --report, with the "
                   "next seed, or as --seed, --style, --path and --velocity say. Repeatable.")
      ->allow_extra_args(false);
  command->add_option("--end", options->end,
                      "End in this pose, given as in --key. The dancer reaches it on the last beat "
                      "that leaves a second, and holds it to the end. A pose of the library stands "
                      "where the dancer is then, and faces the audience. Later keys are removed.");
  command->add_flag(
      "--in-place", options->in_place,
      "Set poses of files, and moved keys, where the dancer stands and faces at that time, too.");
  AddPlacing(*command, options->placing, "each pose of --key");
  AddAllowBends(*command, options->allow_bends);
  command->add_flag("--loop", options->loop,
                    "Lead the last frames back into the first, so that the dance can be repeated. "
                    "A pose that is held at the end, by --report, stays; the way back follows it.");
  command
      ->add_option("--around", options->around_s,
                   "Seconds that may change before and after a key, or before the end of a loop. "
                   "Default: up to the neighbouring keys of --report within 4 s, else 2.")
      ->check(AboveZero());
  command
      ->add_option("--from", options->from,
                   "TIME at which the dance is to begin; it becomes second 0.")
      ->check(TimeOrCount());
  command->add_option("--until", options->until, "TIME before which the dance is to end.")
      ->check(TimeOrCount());
  command->add_flag("--mirror", options->mirror, "Mirror body and stage at the plane x = 0.");
  CLI::Option* join = command->add_option(
      "--join", options->join,
      "Append another dance, moved and turned to where this one ends. The way there is danced, "
      "unless the other dance begins in the pose in which this one ends.");
  join->check(CLI::ExistingFile);
  command
      ->add_option("--gap", options->gap_s,
                   "Seconds of the way to the dance of --join; default: 1. With 0 there is no way, "
                   "and that dance stays where it is.")
      ->needs(join)
      ->check(TimeInSeconds());
  command
      ->add_option("--join-report", options->join_report,
                   "Report of the dance of --join; --new-report takes over its keys.")
      ->needs(join)
      ->check(CLI::ExistingFile);
  command
      ->add_option("--song", options->song,
                   "Music of the dance. Default: the song that --report names. none: new frames "
                   "follow no music.")
      ->check(SongOrNone());
  AddSongStart(*command, options->song_start_s);
  AddBeatOptions(*command, &options->beats);
  command
      ->add_option("--report", options->report,
                   "Report of the dance. It names the keys, and the song, model, seed, style, "
                   "path, velocity, beats, music dynamics and variation, which new frames use "
                   "unless options say otherwise.")
      ->check(CLI::ExistingFile);
  command->add_option("--new-report", options->new_report,
                      "JSON file to write, for the next edit: the keys of the new dance, and the "
                      "warnings about its edits and its unchanged frames.");
  AddSeed(*command, options->seed,
          "Same seed, same edit. Default: the seed of --report, else 0; one more with --retake. " +
              kOfChance);
  AddManner(*command, options.get());
  AddControlOptions(*command, &options->controls);
  AddModel(*command, options->model);
  command
      ->add_option("-o,--out", options->out,
                   "FILE.npz, FILE.bvh, FILE.glb or FILE.vrma to write; FILE.json for a project.")
      ->required();
  options->server.AddTo(*command);
  command->callback([options, command] {
    FillFromReport(command->count("--song-start") > 0, options.get());
    CheckSongStart(*command, options->song);
    Run(*options);
  });
}

}  // namespace choreo::cli
