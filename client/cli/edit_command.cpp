#include <memory>

#include "client/authoring/counts.h"
#include "client/authoring/key_file.h"
#include "client/cli/authoring_options.h"
#include "client/cli/commands.h"
#include "client/cli/edit_markers.h"
#include "client/cli/edit_session.h"
#include "client/cli/edit_whole.h"
#include "client/cli/options.h"
#include "client/cli/output_file.h"
#include "client/cli/report.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

constexpr double kMaxStretch = 4;

bool EditsKeys(const EditOptions& options) {
  return !options.keys.empty() || !options.moves.empty() || !options.removed.empty() ||
         !options.repeats.empty() || !options.stretches.empty() || !options.mirrored.empty() ||
         !options.retakes.empty() || !options.end.empty() || options.loop;
}

bool EditsWhole(const EditOptions& options) {
  return !options.from.empty() || !options.until.empty() || options.mirror || !options.join.empty();
}

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
    throw InvalidArgument("--mark", "is missing, and so is --unmark: nothing is to be changed");
  for (const auto& [id, time] : options.marks) {
    if (id.empty()) throw InvalidArgument("--mark", "has an empty name");
    authoring::ParseTime(time, "--mark");
  }
  RequireExtension("--out", options.out, ".json");
  RequireOutputs({{"--out", options.out}}, {{"dance", options.dance}});
}

void CheckOptions(const EditOptions& options) {
  if (!options.marks.empty() || !options.unmarked.empty())
    throw InvalidArgument("--mark", "goes with a project, and " + options.dance + " is none");
  const bool otherwise = options.changed != DanceChange::kNothing;
  if (!EditsKeys(options) && !EditsWhole(options) && otherwise && options.report.empty()) {
    throw InvalidArgument("--report",
                          "is missing: the whole dance is danced anew, through the keys that it "
                          "names");
  }
  if (!EditsKeys(options) && !EditsWhole(options) && !otherwise) {
    throw InvalidArgument("--key",
                          "is missing, and so are --move, --remove, --repeat, --stretch, "
                          "--mirror-phrase, --retake, --end, --loop, --from, --until, --mirror and "
                          "--join, and --seed, --style, --path and --velocity, which change the "
                          "whole dance: nothing is to be changed");
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
  if (options.report.empty() && !options.new_report.empty()) {
    throw InvalidArgument("--new-report", "needs --report, which it is made of");
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
  EditSession session(options, connection);
  try {
    for (const std::string& id : options.removed) session.RemoveKey(id);
    for (const auto& [id, time] : options.moves)
      session.MoveKey(id, session.Second("--move", time));
    for (const auto& [from, until, times] : options.stretches)
      session.Stretch(session.Second("--stretch", from), session.Second("--stretch", until), times);
    for (const auto& [from, until, later] : options.repeats)
      session.Repeat(session.Second("--repeat", from), session.Second("--repeat", until), later);
    for (const auto& [from, until] : options.mirrored)
      session.MirrorPhrase(session.Second("--mirror-phrase", from),
                           session.Second("--mirror-phrase", until));
    for (size_t i = 0; i < options.keys.size(); ++i)
      session.SetKey(options.keys[i], session.Second("--at", options.at[i]));
    if (!options.end.empty()) session.End(options.end);
    for (const auto& [from, until] : options.retakes)
      session.Retake(session.Second("--retake", from), session.Second("--retake", until));
    if (!EditsKeys(options)) session.DanceOtherwise();
    if (options.loop) session.CloseLoop();
  } catch (const Error& error) {
    throw options.controls.InTermsOf(error);
  }
  session.Write();
}

}  // namespace

void AddEditCommand(CLI::App& program) {
  auto options = std::make_shared<EditOptions>();
  CLI::App* command = program.add_subcommand(
      "edit",
      "Set, move, remove and repeat key poses of a finished dance, dance a part or all of it anew, "
      "or close it to a loop; or cut, mirror and join whole dances.\n"
      "Only the two intervals around a key are danced anew; every other frame stays as it is, bit "
      "for bit. They end at the neighbouring keys, if --report names them within 4 s, else "
      "--around "
      "seconds away. A key at the frame of another one replaces it, which a note says. A TIME is "
      "in seconds, or in counts of "
      "--song: 1c is its first downbeat, 9c the next eight's 1, 9.5c the half beat after it. Keys "
      "are removed first, then moved, stretched, repeated, mirrored and set; takes come after "
      "them. With --seed, --style, --path or --velocity alone all is danced anew, through the "
      "same keys. Whole dances are cut first, then mirrored, then joined.");
  command
      ->add_option("dance", options->dance,
                   MotionFileExtensions() + " file; with --mark and --unmark a project.")
      ->required()
      ->check(CLI::ExistingFile);
  AddRepeated(*command, "-k,--key", options->keys,
              "A pose of the library (kick, ...), which is set where the dancer is; or a "
              "key file with one pose, KEYS.json@ID, or MOTION@SECOND. May be given more than "
              "once, each with its --at.");
  AddRepeated(*command, "--at", options->at,
              "TIME: the second of the dance for the key, or the count (9c).")
      ->check(TimeOrCount());
  command
      ->add_option(
          "--move", options->moves,
          "ID TIME: a key of --report, with what holds it, and the second or count where it "
          "is to stand, as it is danced now. May be given more than once. Of several keys of one "
          "name: ID@TIME, the nearest.")
      ->allow_extra_args(false);
  AddRepeated(*command, "--remove", options->removed,
              "ID: a key of --report to dance on without. May be given more than once. Of several "
              "keys of one name: ID@TIME, the nearest.");
  command
      ->add_option(
          "--mark", options->marks,
          "NAME TIME: a marker to set in a project, or to move to this second or count, if "
          "it has the name already. May be given more than once.")
      ->allow_extra_args(false);
  AddRepeated(*command, "--unmark", options->unmarked,
              "NAME: a marker to remove from a project. Of several of one name: NAME@SECOND.");
  command
      ->add_option("--hold", options->hold,
                   "Seconds, or counts (2c), for which the poses of --key and --move are kept. "
                   "Default: as a key file or --report says, or they are passed.")
      ->check(TimeOrCount());
  AddHit(*command, options->hit, "the poses of --key and --move are");
  AddHands(*command, options->hands,
           "What hands do in the poses of --key and --move, for characters that have fingers "
           "(convert --report)");
  command
      ->add_option("--repeat", options->repeats,
                   "FROM UNTIL LATER: the keys of --report from time FROM on and before UNTIL once "
                   "more, LATER seconds or counts of --song later (8c), moved and turned to "
                   "where the dancer is then. Keys that stood there make way. May be given more "
                   "than once.")
      ->allow_extra_args(false);
  command
      ->add_option("--stretch", options->stretches,
                   "FROM UNTIL TIMES: the keys of --report from time FROM on and before UNTIL, "
                   "TIMES as far from FROM, in counts of --song: 2 for half time, 0.5 for double "
                   "time. They stay where they are on the floor; keys where they come make way. "
                   "May be given more than once.")
      ->allow_extra_args(false);
  command
      ->add_option("--mirror-phrase", options->mirrored,
                   "FROM UNTIL: the keys of --report from time FROM on and before UNTIL with left "
                   "and right exchanged, as seen from where the dancer stands and faces at the "
                   "first of them. May be given more than once.")
      ->allow_extra_args(false);
  command
      ->add_option("--retake", options->retakes,
                   "FROM UNTIL: dances what lies between two times anew, through the keys of "
                   "--report there, which stay: with the seed after the dance's, or as --seed, "
                   "--style, --path and --velocity say. May be given more than once.")
      ->allow_extra_args(false);
  command->add_option("--end", options->end,
                      "A pose as in --key for the dance to end in: on the last beat that leaves a "
                      "second, held to the end. A pose of the library stands where the dancer is "
                      "then, and faces the audience. Later keys make way.");
  command->add_flag("--in-place", options->in_place,
                    "Set poses of files and moved ones, too, where the dancer is and faces at that "
                    "moment.");
  AddAllowBends(*command, options->allow_bends);
  command->add_flag(
      "--loop", options->loop,
      "Lead the last frames back into the first, so that the dance can be repeated. A "
      "pose that --report says is held at the end stays, and the way back comes "
      "after it.");
  command
      ->add_option("--around", options->around_s,
                   "Seconds that may change before and after a key, or before the end of a loop. "
                   "Default: up to the neighbouring keys of --report within 4 s; else 2.")
      ->check(AboveZero());
  command
      ->add_option("--from", options->from,
                   "TIME at which what stays of the dance begins, its second 0 from then on.")
      ->check(TimeOrCount());
  command->add_option("--until", options->until, "TIME before which it ends.")
      ->check(TimeOrCount());
  command->add_flag("--mirror", options->mirror,
                    "Exchange left and right of body and stage: the plane x = 0 is the mirror.");
  CLI::Option* join = command->add_option(
      "--join", options->join,
      "Another dance to put after this one, moved and turned to where this one ends. The way "
      "there is danced, unless it begins in the pose in which this one ends.");
  join->check(CLI::ExistingFile);
  command
      ->add_option("--gap", options->gap_s,
                   "Seconds of that way; default: 1. 0: none, the other dance stays where it is.")
      ->needs(join)
      ->check(TimeInSeconds());
  command
      ->add_option("--join-report", options->join_report,
                   "Its report, whose keys --new-report takes over.")
      ->needs(join)
      ->check(CLI::ExistingFile);
  command
      ->add_option("--song", options->song,
                   "Music that the dance was made to. Default: the song that --report names; none: "
                   "new frames follow no music.")
      ->check(SongOrNone());
  AddSongStart(*command, options->song_start_s);
  AddBeatOptions(*command, &options->beats);
  command
      ->add_option("--report", options->report,
                   "Report of the dance, which names its keys, and also its song, model, seed, "
                   "style, path, velocity, beats, music dynamics and variation, with which new "
                   "frames are danced unless options say otherwise.")
      ->check(CLI::ExistingFile);
  command->add_option("--new-report", options->new_report,
                      "JSON file to write the keys of the new dance to, for the next edit, and the "
                      "warnings of its edits and of frames that stay.");
  AddSeed(
      *command, options->seed,
      "Same seed, same edit. Default: the dance's, by --report, else 0; with --retake one more. " +
          kOfChance);
  AddManner(*command, options.get());
  AddControlOptions(*command, &options->controls);
  AddModel(*command, options->model);
  command
      ->add_option("-o,--out", options->out,
                   "FILE.npz, FILE.bvh, FILE.glb or FILE.vrma to write; of a project, FILE.json.")
      ->required();
  options->server.AddTo(*command);
  command->callback([options, command] {
    FillFromReport(command->count("--song-start") > 0, options.get());
    CheckSongStart(*command, options->song);
    Run(*options);
  });
}

}  // namespace choreo::cli
