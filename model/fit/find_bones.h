#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/fit/human_bones.h"

/// Finds which nodes of a rig are the bones of a body, for motions and characters alike.
namespace choreo {

/// The nodes of a file; some are the bones of one or more bodies.
struct RigNodes {
  std::vector<std::string> names;  ///< may be empty or duplicate
  std::vector<int> parents;        ///< -1: none
  Eigen::Matrix3Xd places;         ///< [3, nodes] at rest in the world
  std::vector<bool> joints;        ///< a skin uses it; all if there is no skin
  std::vector<bool> moves;         ///< an animation moves it; none if there is no animation
  std::vector<bool> meshes;        ///< it holds a mesh, and may only share a bone's name
  HumanBones table = {};           ///< from the file itself, such as VRM's table
};

/// A user's assignment of a bone to a node by name or by number (from 0 on), or to neither, which
/// removes the bone.
struct BoneChoice {
  std::string bone = {};   ///< a name of HumanBones
  std::string name = {};   ///< of a node, or empty
  int node = -1;           ///< if there is no name
  std::string field = {};  ///< the field of errors about it
};

/// Assigns bones from `chosen`, then the file's table, then names. With duplicate names, takes the
/// bones of one skeleton together: prefers the body that moves, and the node with a skin, that
/// moves, that is no mesh. Bones may be missing. Throws Error(kInvalidArgument), whose field is the
/// choice's, for a bone or node that does not exist.
HumanBones FindBones(const RigNodes& rig, const std::vector<BoneChoice>& chosen = {});

/// The bodies that move: `found`, and others with as many bones and none in common, in the file's
/// order.
std::vector<HumanBones> MovingBodies(const RigNodes& rig, const HumanBones& found);

/// The names of a rig tell too little; the caller may guess from its shape (guess_bones.h).
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
