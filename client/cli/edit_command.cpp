#include <memory>

#include "client/cli/commands.h"
#include "client/cli/edit_session.h"
#include "client/cli/json_fields.h"
#include "client/cli/key_file.h"
#include "client/cli/options.h"
#include "client/cli/output_file.h"
#include "model/core/rounded.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

void CheckOptions(const EditOptions& options) {
  const bool of_report = !options.moves.empty() || !options.removed.empty();
  if (options.keys.empty() && !of_report && !options.loop) {
    throw InvalidArgument("--key",
                          "is missing, and so are --move, --remove and --loop: nothing is to be "
                          "changed");
  }
  if (of_report && options.report.empty()) {
    throw InvalidArgument(options.moves.empty() ? "--remove" : "--move",
                          "needs --report, which names the keys");
  }
  for (const auto& [id, at_s] : options.moves) {
    if (!(at_s >= 0 && at_s <= kMaxSeconds)) {
      throw InvalidArgument("--move",
                            InFull(at_s) + " s is not in [0, " + InFull(kMaxSeconds) + "]");
    }
  }
  if (options.keys.size() != options.at_s.size()) {
    throw InvalidArgument("--at", std::to_string(options.at_s.size()) + " times for " +
                                      std::to_string(options.keys.size()) +
                                      " keys; each --key needs one");
  }
  RequireWrittenMotionFile(options.out);
  std::vector<NamedFile> inputs = options.controls.Files();
  inputs.push_back({"dance", options.dance});
  inputs.push_back({"--report", options.report});
  inputs.push_back({"--song", options.song});
  for (const std::string& key : options.keys) inputs.push_back({"--key", FileOf(key)});
  RequireOutputs({{"--out", options.out}, {"--new-report", options.new_report}}, inputs);
  if (options.report.empty() && !options.new_report.empty()) {
    throw InvalidArgument("--new-report", "needs --report, which it is made of");
  }
}

void Run(const EditOptions& options) {
  CheckOptions(options);
  const Connection connection(options.server, options.model);
  EditSession session(options, connection);
  try {
    for (const std::string& id : options.removed) session.RemoveKey(id);
    for (const auto& [id, at_s] : options.moves) session.MoveKey(id, at_s);
    for (size_t i = 0; i < options.keys.size(); ++i)
      session.SetKey(options.keys[i], options.at_s[i]);
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
      "Set, move and remove key poses of a finished dance, or close it to a loop.\n"
      "Only the two intervals around a key are danced anew; every other frame stays as it is, bit "
      "for bit. They end at the neighbouring keys, if --report names them, else --around seconds "
      "away. A key at the frame of another one replaces it. Keys are removed first, then moved, "
      "then set.");
  command->add_option("dance", options->dance, MotionFileExtensions() + " file.")
      ->required()
      ->check(CLI::ExistingFile);
  AddRepeated(*command, "-k,--key", options->keys,
              "A pose of the library (kick, ...), which is set where the dancer is; or a "
              "key file with one pose, KEYS.json@ID, or MOTION@SECOND. May be given more than "
              "once, each with its --at.");
  AddRepeated(*command, "--at", options->at_s, "Second of the dance for the key.")
      ->check(TimeInSeconds());
  command
      ->add_option("--move", options->moves,
                   "ID TIME: a key of --report, with what holds it, and the second where it is to "
                   "stand, as it is danced now. May be given more than once.")
      ->allow_extra_args(false);
  AddRepeated(*command, "--remove", options->removed,
              "ID: a key of --report to dance on without. May be given more than once. Of several "
              "keys of one name: ID@SECOND.");
  command->add_flag("--in-place", options->in_place,
                    "Set poses of files and moved ones, too, where the dancer is and faces at that "
                    "moment.");
  AddAllowBends(*command, options->allow_bends);
  command->add_flag(
      "--loop", options->loop,
      "Lead the last frames back into the first, so that the dance can be repeated. A "
      "pose that --report says is held at the end stays, and the way back comes "
      "behind it.");
  command
      ->add_option("--around", options->around_s,
                   "Seconds that may change before and behind a key, or before the end of a loop. "
                   "Default: up to the neighbouring keys of --report; 2 without it.")
      ->check(AboveZero());
  command->add_option("--song", options->song, "Music that the dance was made to.")
      ->check(CLI::ExistingFile);
  AddSongStart(*command, options->song_start_s);
  command->add_option("--report", options->report, "Report of the dance, which names its keys.")
      ->check(CLI::ExistingFile);
  command->add_option("--new-report", options->new_report,
                      "JSON file to write the keys of the new dance to, for the next edit, and the "
                      "warnings of its edits and of frames that stay.");
  AddSeed(*command, options->seed, "Same seed, same edit. Default: 0. " + kOfChance);
  AddTemperature(*command, options->temperature);
  AddMusicDynamics(*command, options->music_dynamics);
  AddVariation(*command, options->variation);
  AddStyle(*command, options->style);
  options->controls.AddTo(*command);
  AddModel(*command, options->model);
  command->add_option("-o,--out", options->out, "FILE.npz, FILE.bvh or FILE.glb to write.")
      ->required();
  options->server.AddTo(*command);
  command->callback([options, command] {
    CheckSongStart(*command, options->song);
    Run(*options);
  });
}

}  // namespace choreo::cli
