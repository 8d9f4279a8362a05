#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/fit/human_bones.h"

/// Which nodes of a rig are the bones of a body: one answer for motions and characters.
namespace choreo {

/// The nodes of a file, of which some are the bones of a body, or of several.
struct RigNodes {
  std::vector<std::string> names;  ///< may be empty or there twice
  std::vector<int> parents;        ///< -1: none
  Eigen::Matrix3Xd places;         ///< [3, nodes] at rest in the world
  std::vector<bool> joints;        ///< a skin hangs on it; all where there is no skin
  std::vector<bool> moves;         ///< an animation moves it; none where there is no animation
  std::vector<bool> meshes;        ///< it holds a mesh, and may only be called as a bone
  HumanBones table = {};           ///< what the file itself says, as VRM's table does
};

/// That a bone is a node, as somebody says: a name, or a number from 0 on, or neither, which takes
/// the bone away.
struct BoneChoice {
  std::string bone = {};   ///< as HumanBones has it
  std::string name = {};   ///< of a node, or empty
  int node = -1;           ///< where there is no name
  std::string field = {};  ///< who says so, for messages
};

/// What `chosen` says, then the file's table, then names. Where names are there twice, the bones of
/// one skeleton are taken together: of several bodies the one that moves, of several nodes of it
/// the one that a skin hangs on, that moves, that is no mesh. Bones may be missing. Throws
/// Error(kInvalidArgument) whose field is the choice's for a bone or node that there is not.
HumanBones FindBones(const RigNodes& rig, const std::vector<BoneChoice>& chosen = {});

/// The bodies that move: `found`, and others of as many bones that share none with it, in the order
/// in which they stand in the file.
std::vector<HumanBones> MovingBodies(const RigNodes& rig, const HumanBones& found);

/// A rig whose names tell too little. Whoever asked may look at it (guess_bones.h).
class UnknownBones : public Error {
 public:
  UnknownBones(const std::string& field, const std::string& missing, RigNodes rig,
               HumanBones found);

  const RigNodes& rig() const { return rig_; }
  const HumanBones& found() const { return found_; }
  const std::string& missing() const { return missing_; }

 private:
  RigNodes rig_;
  HumanBones found_;
  std::string missing_;
};

}  // namespace choreo
