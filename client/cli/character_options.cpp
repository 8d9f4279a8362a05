#include "client/cli/character_options.h"

#include <algorithm>

#include "client/cli/bone_map.h"
#include "model/core/error.h"
#include "model/fit/guess_bones.h"
#include "model/fit/retarget.h"
#include "model/fit/transfer.h"
#include "model/formats/character_file.h"
#include "model/formats/motion_file.h"

namespace choreo::cli {
namespace {

// Says what is missing, and leaves a suggestion beside `out`.
[[noreturn]] void Suggest(const std::filesystem::path& out, const CharacterFile& character,
                          const std::string& name, HumanBones found) {
  const GltfNodes& nodes = character.nodes();
  if (nodes.names.empty()) throw InvalidArgument(name, "has no nodes");
  const std::string missing = MissingBone(found);
  const HumanBones guess = GuessBones(nodes.parents, character.places(), character.joints());
  for (const auto& [bone, node] : guess.bones) {
    const bool taken =
        std::ranges::any_of(found.bones, [n = node](const auto& o) { return o.second == n; });
    if (!taken) found.bones.try_emplace(bone, node);
  }
  const std::filesystem::path stem = std::filesystem::path(out).replace_extension();
  const std::filesystem::path map = stem.string() + ".map.json",
                              picture = stem.string() + ".map.png";
  if (std::filesystem::exists(map)) {
    throw InvalidArgument(name, "its names do not say which bone is the " + missing + "; " +
                                    map.string() + " is there already: --map it, or remove it");
  }
  WriteBoneMap(map, picture, character, found);
  throw InvalidArgument(name, "its names do not say which bone is the " + missing + "; " +
                                  map.string() + " is a guess, " + picture.string() +
                                  " a picture: mend the one by the other, then --map " +
                                  map.string());
}

}  // namespace

void CharacterOptions::AddTo(CLI::App& command) {
  command
      .add_option("--character", character,
                  "FILE.glb or FILE.vrm: a character of your own, which dances in OUT.glb.")
      ->check(CLI::ExistingFile);
  command
      .add_option(
          "--map", map,
          "FILE.json that says which of its nodes are which bones, where their names do not.")
      ->check(CLI::ExistingFile);
}

void CharacterOptions::Check(const std::filesystem::path& out) const {
  if (!given()) {
    if (!map.empty()) throw InvalidArgument("--map", "goes with --character");
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
                             const Motion& motion) const {
  const CharacterFile file(character);
  HumanBones bones = file.FindBones();
  if (!map.empty()) bones = ReadBoneMap(map, file, std::move(bones));
  if (map.empty() && !MissingBone(bones).empty()) Suggest(out, file, character, std::move(bones));
  CharacterBody body;
  try {
    body = MakeCharacterBody(bones, file.places());
  } catch (const Error& error) {
    throw Error(error.code(), map.empty() ? character : map, error.what());
  }
  const Motion smpl = Retarget(skeleton, motion, Skeleton::Smpl24());
  file.WriteDance(out, body, TransferToCharacter(smpl, body.skeleton));
}

}  // namespace choreo::cli
