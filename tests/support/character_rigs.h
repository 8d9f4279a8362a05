#pragma once

#include <filesystem>
#include <string>

#include "tests/support/proportions.h"

/// Character files for tests: the doll with other names and bones.
namespace choreo::testing_support {

struct CharacterRig {
  std::string rig =
      "Mixamo and HumanIK";  ///< the naming (fit/bones/human_bones.h); empty: no names
  std::string prefix = "mixamorig:";
  Skeleton body = Skeleton::Smpl24();  ///< the proportions
  double arms_down = 0;                ///< at rest, degrees: 45 is an A-pose
  bool rolled = false;                 ///< bones have unusual frames
  /// Scale of a node above all bones, rotated by -90 degrees about X. The bones are scaled back.
  double armature_scale = 1;
  double facing = 0;  ///< at rest, degrees
};

/// Writes the rig as .glb, with a mesh and a skin, without animation.
void WriteCharacter(const std::filesystem::path& glb, const CharacterRig& rig);

}  // namespace choreo::testing_support
