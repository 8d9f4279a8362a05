#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "client/authoring/keys/motion_input.h"
#include "client/cli/commands/commands.h"
#include "client/cli/options/bone_map.h"
#include "client/cli/options/bvh_options.h"
#include "client/cli/options/character_options.h"
#include "client/cli/options/options.h"
#include "client/cli/options/output_file.h"
#include "model/core/error.h"
#include "model/core/files/small_extension.h"
#include "model/fit/retarget.h"
#include "model/formats/arrays/own_arrays.h"
#include "model/formats/gltf/gltf.h"
#include "model/formats/motion_file.h"
#include "model/formats/reading/root_motion.h"
#include "model/motion/floor/contacts.h"
#include "model/motion/resample.h"

namespace choreo::cli {
namespace {

const std::map<std::string, RootMotion> kRootMotions = {{"pelvis", RootMotion::kPelvis},
                                                        {"root", RootMotion::kRoot},
                                                        {"in-place", RootMotion::kInPlace}};

struct ConvertOptions {
  std::string in;
  std::string out;
  double fps = 0;
  bool smpl = false;
  MotionReading reading;
  std::string motion_map;
  BvhOptions bvh;
  CharacterOptions character;
  std::string root_motion = "pelvis";

  /// The map for the motion's bones: `--map` if there is no character.
  const std::string& map() const {
    return motion_map.empty() && !character.given() ? character.map : motion_map;
  }
};

SkeletonMotion Read(const ConvertOptions& options) {
  MotionReading reading = options.reading;
  reading.fps = options.fps;
  if (!options.map().empty()) reading.bones = ReadBoneMap(options.map());
  try {
    return authoring::ReadMotionNoting(options.in, reading);
  } catch (const UnknownBones& error) {
    if (!options.map().empty()) {
      throw InvalidArgument(options.map(), "does not say which bone is the " + error.missing() +
                                               ", nor do the names of " + options.in);
    }
    SuggestBoneMap(options.out, options.in, error.rig(), error.found());
  }
}

void Run(const ConvertOptions& options) {
  RequireMotionFile(options.in);
  RequireWrittenMotionFile(options.out);
  options.bvh.Check(options.out);
  options.character.Check(options.out, true);
  const RootMotion root = kRootMotions.at(options.root_motion);
  const bool is_glb = SmallExtension(options.out) == ".glb";
  if (root == RootMotion::kRoot && !is_glb)
    throw InvalidArgument("--root-motion", "root is for a .glb, not for " + options.out);
  if (!options.reading.up.empty()) ParseUp(options.reading.up);
  CheckAngles(options.reading.angles);
  RequireOutputs({{"out", options.out}}, {{"in", options.in},
                                          {"--character", options.character.character},
                                          {"--map", options.character.map},
                                          {"--report", options.character.report},
                                          {"--motion-map", options.motion_map}});
  auto [skeleton, motion] = Read(options);
  if (options.smpl) {
    motion = Retarget(skeleton, motion, Skeleton::Smpl24());
    skeleton = Skeleton::Smpl24();
  }
  if (options.fps > 0) motion = Resample(motion, options.fps);
  if (options.character.given()) {
    options.character.Write(options.out, skeleton, motion, root);
  } else if (is_glb && root == RootMotion::kRoot) {
    WriteGlb(options.out, skeleton, motion, root);
  } else {
    const std::vector<Contacts> contacts = DetectContacts(skeleton, motion);
    if (root == RootMotion::kInPlace) motion = InPlace(std::move(motion));
    options.bvh.Write(options.out, skeleton, motion, contacts);
  }
  std::cout << options.out << std::endl;
}

}  // namespace

void AddConvertCommand(CLI::App& program) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = program.add_subcommand(
      "convert",
      "Read a motion and write it in another format: .npz (SMPL, as AMASS), .bvh, .glb (glTF, with "
      "a body to look at) or .vrma (for VRM avatars).\nOther rigs become SMPL's body, bone by "
      "bone. A dance of a model with its own skeleton keeps that skeleton.");
  command->add_option("in", options->in, "Motion to read: " + MotionFileExtensions() + ".")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("out", options->out, "FILE.npz, FILE.bvh, FILE.glb or FILE.vrma to write.")
      ->required();
  command
      ->add_option("--fps", options->fps,
                   "Frames a second to resample to; for a motion that states no rate, its rate. "
                   "Default: unchanged.")
      ->check(NumberFrom(kMinFileFps, kMaxFileFps));
  command->add_option("--up", options->reading.up,
                      "Axis of the file that points up: y, z, x, -y, -z or -x. Default: by the "
                      "format, or by how the body stands.");
  command
      ->add_option("--scale", options->reading.scale,
                   "Metres in the file's unit, 0.01 for centimetres. Default: by the format, or by "
                   "the legs.")
      ->check(NumberFrom(1e-6, 1e6));
  command->add_option("--angles", options->reading.angles,
                      "Unit of the file's angles, degrees or radians. Default: by the format, or "
                      "by what a body can do.");
  command->add_option("--animation", options->reading.animation,
                      "Animation of a file with several: its name, or its number from 0 on. "
                      "Default: the first that moves most bones.");
  command->add_option("--body", options->reading.body,
                      "Body of a file with several that move: its name, or its number from 0 on. "
                      "Default: the first.");
  command
      ->add_option("--motion-map", options->motion_map,
                   "FILE.json that says which nodes of the motion are which bones. Without "
                   "--character, --map is the same.")
      ->check(CLI::ExistingFile);
  command->add_flag("--smpl", options->smpl,
                    "Retarget a motion with another skeleton to SMPL's 24 joints.");
  command
      ->add_option("--root-motion", options->root_motion,
                   "What carries the dancer over the floor, for game engines: pelvis (default); "
                   "root, a joint on the floor above the pelvis (.glb, also with --character); or "
                   "in-place, nothing: she turns and jumps on the spot.")
      ->check(CLI::IsMember(kRootMotions));
  options->bvh.AddTo(*command);
  options->character.AddTo(*command);
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
