#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/fit/bones/character_body.h"
#include "model/fit/bones/find_bones.h"
#include "model/fit/bones/finger_bones.h"
#include "model/formats/gltf/gltf_nodes.h"
#include "model/formats/reading/root_motion.h"
#include "model/motion/motion.h"

namespace choreo {

/// A character in a binary glTF file (.glb, .vrm) with mesh, skin, materials and any extensions.
/// Parses only the nodes. Immutable; thread-safe.
class CharacterFile {
 public:
  /// Throws Error(kNotFound) if the file cannot be opened; Error(kInvalidArgument) whose field
  /// begins with the path if it is not a binary glTF, keeps data in other files, or has nodes that
  /// are their own ancestors, have two parents, or are outside the scene.
  explicit CharacterFile(const std::filesystem::path& path);

  const GltfNodes& nodes() const { return nodes_; }
  /// The nodes, for finding bones (fit/bones/find_bones.h), in the file's unit.
  const RigNodes& rig() const { return rig_; }
  const Eigen::Matrix3Xd& places() const { return rig_.places; }

  /// FindBones of find_bones.h for this file.
  HumanBones FindBones(const std::vector<BoneChoice>& chosen = {}) const {
    return choreo::FindBones(rig_, chosen);
  }

  /// Writes the character with the dance as its first animation, "dance", whose extras hold `fps`.
  /// Everything else stays byte for byte. In the file's world the dance keeps our axes, Y up and +Z
  /// ahead, however the character faces at rest. `motion` is of `body.skeleton`, and `body` of this
  /// file. `fingers` have one angle, or one per frame. Throws Error(kInvalidArgument) for a motion
  /// without frames, zero scales, or more than 4 GiB; Error(kInternal) if the file cannot be
  /// written. With RootMotion::kRoot, the node right above all bones carries the character over the
  /// floor, or a new node above the pelvis if there is none. Throws Error(kInvalidArgument) if no
  /// one node is above the bones.
  void WriteDance(const std::filesystem::path& out, const CharacterBody& body, const Motion& motion,
                  const std::vector<CurledBone>& fingers = {},
                  RootMotion root = RootMotion::kPelvis) const;

 private:
  std::filesystem::path path_;
  std::string bytes_;
  GltfNodes nodes_;
  RigNodes rig_;
};

}  // namespace choreo
