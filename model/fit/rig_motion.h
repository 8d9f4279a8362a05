#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/fit/human_bones.h"
#include "model/motion/motion.h"

/// A recording of somebody else's rig → rotations of SMPL's body: bone by bone, from rest pose to
/// rest pose, with the joints' places as a correction.
namespace choreo {

/// Where the bones of a rig are, in the axes and the unit of its file.
struct RigPlacement {
  Eigen::Matrix3Xd places;             ///< [3, bones]
  std::vector<Eigen::Matrix3d> turns;  ///< [bones] in the world
};

/// A recording of a rig: of its bones, not of all its nodes.
struct RigMotion {
  double fps = 0;
  HumanBones bones = {};                 ///< which of the columns is which
  std::vector<std::string> names = {};   ///< [bones] as the file has them
  std::vector<RigPlacement> rests = {};  ///< what may be its rest pose, best first
  /// How many of these, the first, stand in axes of their own, as a skin's do.
  size_t rests_apart = 0;
  int64_t count = 0;  ///< frames
  std::function<RigPlacement(int64_t frame)> frame = {};
};

/// What was done with one.
struct RigFit {
  Motion motion;  ///< of SMPL's body, in the rig's axes: as high above the floor as it was
  /// The rig's axis along which its rest pose stands, if that is a body's.
  std::optional<Eigen::Vector3d> up = {};
  bool rest = true;   ///< false: its rest pose is no body's, what bones are at rest is a guess
  bool turns = true;  ///< false: its rotations do not carry its joints, positions alone were fitted
  std::vector<std::string> missing;  ///< "neck", "head", "collars", "toes": what it has not
  /// Whose left is on the right, as in a mirror, or "": "body", "arms" or "legs". They were taken
  /// by where they stand.
  std::string exchanged = {};
};

/// Limbs point where the rig's do. Pelvis, chest, head, hands and feet are turned in the world as
/// the rig's bones are since its rest pose; where that is no body's (all bones along one axis, as
/// in some), since a rest that the whole clip's positions tell (fit_clip.h). Ways are multiplied by
/// `scale`, 0: by our legs' length over the rig's. Throws Error(kInvalidArgument) for a rig without
/// frames, without size, and naming a bone that is needed and missing (MissingBone).
RigFit FitRig(const RigMotion& rig, double scale = 0);

}  // namespace choreo
