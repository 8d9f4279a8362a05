#include <memory>

#include "client/cli/bvh_options.h"
#include "client/cli/character_options.h"
#include "client/cli/commands.h"
#include "client/cli/options.h"
#include "client/cli/output_file.h"
#include "model/fit/retarget.h"
#include "model/formats/motion_file.h"
#include "model/formats/own_arrays.h"
#include "model/motion/contacts.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

struct ConvertOptions {
  std::string in;
  std::string out;
  double fps = 0;
  bool smpl = false;
  BvhOptions bvh;
  CharacterOptions character;
};

void Run(const ConvertOptions& options) {
  RequireMotionFile(options.out);
  options.bvh.Check(options.out);
  options.character.Check(options.out);
  RequireOutputs({{"out", options.out}}, {{"in", options.in},
                                          {"--character", options.character.character},
                                          {"--map", options.character.map}});
  auto [skeleton, motion] = ReadMotion(options.in);
  if (options.smpl) {
    motion = Retarget(skeleton, motion, Skeleton::Smpl24());
    skeleton = Skeleton::Smpl24();
  }
  if (options.fps > 0) motion = Resample(motion, options.fps);
  if (options.character.given()) return options.character.Write(options.out, skeleton, motion);
  const std::vector<Contacts> contacts = DetectContacts(skeleton, motion);
  options.bvh.Write(options.out, skeleton, motion, contacts);
}

}  // namespace

void AddConvertCommand(CLI::App& program) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = program.add_subcommand(
      "convert",
      "Read a motion and write it in another format: .npz (SMPL, as AMASS), .bvh or .glb\n"
      "(glTF, with a body to look at). A BVH or glTF of another skeleton is fitted to SMPL's; a "
      "dance\n"
      "of a model with a skeleton of its own keeps that.");
  command->add_option("in", options->in, "Motion to read.")->required()->check(CLI::ExistingFile);
  command->add_option("out", options->out, "FILE.npz, FILE.bvh or FILE.glb to write.")->required();
  command->add_option("--fps", options->fps, "Resample to this rate; default: as it is.")
      ->check(NumberFrom(kMinFileFps, kMaxFileFps));
  command->add_flag("--smpl", options->smpl,
                    "Retarget what has a skeleton of its own to SMPL's 24 joints.");
  options->bvh.AddTo(*command);
  options->character.AddTo(*command);
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
