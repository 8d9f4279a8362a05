#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "model/formats/root_motion.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

namespace choreo::cli {

/// `--character`, `--map`, `--hands` and `--report`: a dance on a user's character.
struct CharacterOptions {
  std::string character;   ///< .glb or .vrm; empty: none
  std::string map;         ///< bone_map.h; empty: by names
  std::string hands = "";  ///< one of kHandPoseNames; empty: relaxed
  std::string report;      ///< whose keys say what hands do; or empty

  void AddTo(CLI::App& command);
  bool given() const { return !character.empty(); }
  /// Throws Error(kInvalidArgument) whose field is the option: `--map`, `--hands`
  /// or `--report` alone, a
  /// character other than .glb or .vrm, an `out` other than .glb. `of_motion`: without a character
  /// the map is for the motion's own bones.
  void Check(const std::filesystem::path& out, bool of_motion = false) const;

  /// Writes the character with the dance (formats/character_file.h). If names tell too little,
  /// writes OUT.map.json and OUT.map.png, a suggestion, and throws Error(kInvalidArgument) naming
  /// them.
  void Write(const std::filesystem::path& out, const Skeleton& skeleton, const Motion& motion,
             RootMotion root = RootMotion::kPelvis) const;
};

}  // namespace choreo::cli
