#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "model/formats/reading/root_motion.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo::cli {

/// `--character`, `--map`, `--hands` and `--report`: a dance on a user's character.
struct CharacterOptions {
  std::string character;   ///< .glb or .vrm; empty: none
  std::string map;         ///< a bone map (bone_map.h); empty: finds bones by their names
  std::string hands = "";  ///< one of kHandPoseNames; empty: relaxed
  std::string report;      ///< a report whose keys give the hands' poses; or empty

  void AddTo(CLI::App& command);
  bool given() const { return !character.empty(); }
  /// Throws Error(kInvalidArgument), whose field is the option, for `--map`, `--hands` or
  /// `--report` without a character, for a character other than .glb or .vrm, and for an `out`
  /// other than .glb. `of_motion`: without a character, `--map` is allowed and is for the motion's
  /// own bones.
  void Check(const std::filesystem::path& out, bool of_motion = false) const;

  /// Writes the character with the dance (formats/gltf/character_file.h). If its bones cannot be
  /// found by name, writes a suggested map, OUT.map.json and OUT.map.png, and throws
  /// Error(kInvalidArgument) naming both files.
  void Write(const std::filesystem::path& out, const Skeleton& skeleton, const Motion& motion,
             RootMotion root = RootMotion::kPelvis) const;
};

}  // namespace choreo::cli
