#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/fit/bones/human_bones.h"
#include "model/motion/motion.h"

/// Converts a recording of any rig to rotations of SMPL's body: bone by bone, relative to the rest
/// poses, corrected by the joints' positions.
namespace choreo {

/// The placement of a rig's bones in the world, in the axes and unit of its file.
struct RigPlacement {
  Eigen::Matrix3Xd places;             ///< [3, bones]
  std::vector<Eigen::Matrix3d> turns;  ///< [bones] global rotations
};

/// A recording of a rig's bones, without its other nodes.
struct RigMotion {
  double fps = 0;
  HumanBones bones = {};                 ///< the bone of each column
  std::vector<std::string> names = {};   ///< [bones] names in the file
  std::vector<RigPlacement> rests = {};  ///< candidates for the rest pose, best first
  /// How many of the first `rests` have other axes than the file, as a skin's bind pose may.
  size_t rests_apart = 0;
  int64_t count = 0;  ///< frames
  std::function<RigPlacement(int64_t frame)> frame = {};
};

/// The result of FitRig.
struct RigFit {
  Motion motion;  ///< of SMPL's body, in the rig's axes, at the rig's height above the floor
  /// The rig's up axis, if its rest pose is a standing body.
  std::optional<Eigen::Vector3d> up = {};
  bool rest = true;  ///< false: the rig's rest pose is not a body, so rest rotations are estimated
  bool turns =
      true;  ///< false: the rig's rotations do not move its joints, so only positions were fitted
  std::vector<std::string> missing;  ///< the rig's missing parts: "neck", "head", "collars", "toes"
  /// The part whose left and right are exchanged in the file: "body", "arms", "legs" or "". Its
  /// sides were assigned by position.
  std::string exchanged = {};
};

/// Fits SMPL's body to a rig. Limbs point where the rig's do. Pelvis, chest, head, hands and feet
/// have the world rotations of the rig's bones since its rest pose. If that is not a body (some
/// rigs lay all bones along one axis), rest rotations are estimated from the whole clip's positions
/// (fit_clip.h). `scale` multiplies travel; 0: our legs' length over the rig's. Throws
/// Error(kInvalidArgument) for a rig without frames or size, and for a missing bone that is needed
/// (MissingBones).
RigFit FitRig(const RigMotion& rig, double scale = 0);

}  // namespace choreo
