#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/fit/human_bones.h"
#include "model/motion/motion.h"

/// Converts a recording of a foreign rig to rotations of SMPL's body, bone by bone from rest pose
/// to rest pose, corrected by the joints' positions.
namespace choreo {

/// The placement of a rig's bones, in the axes and unit of its file.
struct RigPlacement {
  Eigen::Matrix3Xd places;             ///< [3, bones]
  std::vector<Eigen::Matrix3d> turns;  ///< [bones] in the world
};

/// A recording of a rig's bones (other nodes are omitted).
struct RigMotion {
  double fps = 0;
  HumanBones bones = {};                 ///< the bone of each column
  std::vector<std::string> names = {};   ///< [bones] names in the file
  std::vector<RigPlacement> rests = {};  ///< candidates for its rest pose, best first
  /// How many of the first rests have axes of their own, as a skin's do.
  size_t rests_apart = 0;
  int64_t count = 0;  ///< frames
  std::function<RigPlacement(int64_t frame)> frame = {};
};

/// The result of fitting a rig.
struct RigFit {
  Motion motion;  ///< of SMPL's body, in the rig's axes, as high above the floor as before
  /// The rig's up axis, if its rest pose is a body's.
  std::optional<Eigen::Vector3d> up = {};
  bool rest = true;   ///< false: its rest pose is no body's, what bones are at rest is a guess
  bool turns = true;  ///< false: its rotations do not carry its joints, positions alone were fitted
  std::vector<std::string> missing;  ///< its missing parts: "neck", "head", "collars", "toes"
  /// The part whose left and right were exchanged in the file: "body", "arms", "legs", or "" for
  /// none. Its sides were assigned by position.
  std::string exchanged = {};
};

/// Limbs point where the rig's do. Pelvis, chest, head, hands and feet turn in the world as the
/// rig's bones have since its rest pose; if that is not a body's (some rigs lay all bones along one
/// axis), since a rest that is estimated from the whole clip's positions (fit_clip.h). `scale`
/// multiplies travel; 0: our legs' length over the rig's. Throws Error(kInvalidArgument) for a rig
/// without frames or size, and for a missing bone that is needed (MissingBone).
RigFit FitRig(const RigMotion& rig, double scale = 0);

}  // namespace choreo
