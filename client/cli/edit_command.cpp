#include <memory>

#include "client/cli/commands.h"
#include "client/cli/edit_session.h"
#include "client/cli/key_file.h"
#include "client/cli/options.h"
#include "client/cli/output_file.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

void CheckOptions(const EditOptions& options) {
  if (options.keys.empty() && !options.loop) {
    throw InvalidArgument("--key", "is missing, and so is --loop: nothing is to be changed");
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
      "Set key poses into a finished dance, or close it to a loop.\n"
      "Only the two intervals around a key are danced anew; every other frame stays as it is, bit "
      "for bit. They end at the neighbouring keys, if --report names them, else --around seconds "
      "away. A key at the frame of another one replaces it.");
  command->add_option("dance", options->dance, MotionFileExtensions() + " file.")
      ->required()
      ->check(CLI::ExistingFile);
  AddRepeated(*command, "-k,--key", options->keys,
              "A pose of the library (kick, ...), which is set where the dancer is; or a "
              "key file with one pose, KEYS.json@ID, or MOTION@SECOND. May be given more than "
              "once, each with its --at.");
  AddRepeated(*command, "--at", options->at_s, "Second of the dance for the key.")
      ->check(TimeInSeconds());
  command->add_flag("--in-place", options->in_place,
                    "Set poses of files, too, where the dancer is and faces at that moment.");
  AddAllowBends(*command, options->allow_bends);
  command->add_flag("--loop", options->loop,
                    "Lead the last frames back into the first, so that the dance can be repeated.");
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
