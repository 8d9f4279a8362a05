#include "client/cli/options/character_options.h"

#include <algorithm>
#include <iostream>
#include <vector>

#include "client/cli/options/bone_map.h"
#include "client/cli/options/options.h"
#include "client/cli/report/report_file.h"
#include "model/core/error.h"
#include "model/core/files/small_extension.h"
#include "model/fit/bones/finger_bones.h"
#include "model/fit/bones/transfer.h"
#include "model/fit/retarget.h"
#include "model/formats/gltf/character_file.h"

namespace choreo::cli {
void CharacterOptions::AddTo(CLI::App& command) {
  command
      .add_option("--character", character,
                  "FILE.glb or FILE.vrm: your own character, which dances in OUT.glb.")
      ->check(CLI::ExistingFile);
  command
      .add_option(
          "--map", map,
          "FILE.json that says which nodes of --character are which bones, if their names do not.")
      ->check(CLI::ExistingFile);
  AddHands(command, hands, "Fingers of --character (default: relaxed; rest: as in its file)");
  command
      .add_option("--report", report,
                  "Report of the dance. If its keys name hands, the fingers of --character move "
                  "from key to key, and --hands has no effect.")
      ->check(CLI::ExistingFile);
}

void CharacterOptions::Check(const std::filesystem::path& out, bool of_motion) const {
  if (!given()) {
    for (const auto& [option, value] : {std::pair("--hands", &hands), {"--report", &report}})
      if (!value->empty()) throw InvalidArgument(option, "goes with --character");
    if (!map.empty() && !of_motion) throw InvalidArgument("--map", "goes with --character");
    return;
  }
  const std::string extension = SmallExtension(character);
  if (extension != ".glb" && extension != ".vrm") {
    throw InvalidArgument("--character",
                          character + " has the extension '" + extension +
                              "', must be .glb (glTF binary, all in one file) or .vrm");
  }
  if (SmallExtension(out) != ".glb")
    throw InvalidArgument("--character", "is written to a .glb, not to " + out.string());
}

void CharacterOptions::Write(const std::filesystem::path& out, const Skeleton& skeleton,
                             const Motion& motion, RootMotion root) const {
  const CharacterFile file(character);
  const HumanBones bones =
      file.FindBones(map.empty() ? std::vector<BoneChoice>() : ReadBoneMap(map));
  if (map.empty() && !MissingBones(bones).empty())
    SuggestBoneMap(out, character, file.rig(), bones);
  CharacterBody body;
  try {
    body = MakeCharacterBody(bones, file.places());
  } catch (const Error& error) {
    throw Error(error.code(), map.empty() ? character : map, error.what());
  }
  const Motion smpl = Retarget(skeleton, motion, Skeleton::Smpl24());
  std::vector<HandKey> keys;
  if (!report.empty()) keys = HandKeys(ReadReport(report));
  if (!keys.empty() && !hands.empty())
    std::cerr << "note: --hands has no effect: keys of " << report << " name hands\n";
  const std::vector<CurledBone> fingers =
      keys.empty()
          ? CurlFingers(file.rig(), bones, *FindHandPose(hands.empty() ? "relaxed" : hands))
          : CurlFingers(file.rig(), bones, keys, std::ssize(smpl.frames), smpl.fps);
  file.WriteDance(out, body, TransferToCharacter(smpl, body.skeleton), fingers, root);
}

}  // namespace choreo::cli
