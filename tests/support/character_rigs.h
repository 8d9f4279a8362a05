#pragma once

#include <filesystem>
#include <string>

#include "tests/support/proportions.h"

/// Characters of our own making: the doll, under other names and with other bones.
namespace choreo::testing_support {

struct CharacterRig {
  std::string rig = "Mixamo and HumanIK";  ///< whose names (fit/human_bones.h); empty: none at all
  std::string prefix = "mixamorig:";
  Skeleton body = Skeleton::Smpl24();  ///< its proportions
  double arms_down = 0;                ///< at rest, degrees: 45 is an A-pose
  bool rolled = false;                 ///< bones have odd frames
  /// A node above all: turned by -90 degrees about X, so scaled, with its bones scaled back.
  double armature_scale = 1;
  double facing = 0;  ///< at rest, degrees
};

/// Writes the rig as .glb, with a mesh, a skin and without an animation.
void WriteCharacter(const std::filesystem::path& glb, const CharacterRig& rig);

}  // namespace choreo::testing_support
