#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/fit/bones/human_bones.h"

/// Finds the nodes of a rig that are the bones of a body, in motion files and character files.
namespace choreo {

/// The nodes of a file; some are the bones of one or more bodies.
struct RigNodes {
  std::vector<std::string> names;  ///< may be empty or duplicate
  std::vector<int> parents;        ///< -1: none
  Eigen::Matrix3Xd places;         ///< [3, nodes] at rest in the world
  std::vector<bool> joints;        ///< a skin uses the node; all true if there is no skin
  std::vector<bool> moves;   ///< an animation moves the node; all false if there is no animation
  std::vector<bool> meshes;  ///< the node holds a mesh, which often has a bone's name
  HumanBones table = {};     ///< bones that the file itself names, as VRM does
};

/// A user's assignment of a bone to a node, by name or by number from 0 on. Without either, the
/// bone is removed.
struct BoneChoice {
  std::string bone = {};   ///< a name of HumanBones
  std::string name = {};   ///< of a node, or empty
  int node = -1;           ///< if there is no name
  std::string field = {};  ///< the field of errors about the choice
};

/// Assigns bones by `chosen`, then by the file's table, then by names. Among duplicate names, takes
/// all bones from one skeleton. Prefers the body that moves, and nodes that a skin uses, that move,
/// and that hold no mesh. Bones may be missing. Throws Error(kInvalidArgument), whose field is the
/// choice's, for a bone or node that does not exist.
HumanBones FindBones(const RigNodes& rig, const std::vector<BoneChoice>& chosen = {});

/// Returns the bodies that move: `found`, and others with as many bones, none of them shared, in
/// the file's order.
std::vector<HumanBones> MovingBodies(const RigNodes& rig, const HumanBones& found);

/// Thrown if the names of a rig do not identify enough bones. The caller may guess them from the
/// rig's shape (guess_bones.h).
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
