#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "model/formats/motion_reading.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Plausibility checks of motions from all formats. Corrects and notes certain errors; notes
/// possible errors with the option that corrects them.
namespace choreo {

/// A motion in the axes and units of its file.
struct FileMotion {
  Skeleton skeleton;
  Motion motion;
  /// The file's up axis, by its format; the motion's own trunk may say otherwise.
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  /// The axis along which the rig's rest pose stands, if it does.
  std::optional<Eigen::Vector3d> rest_up = {};
  /// Position of joint 0 relative to the file's root position, in the file's metres and axes.
  Eigen::Vector3d root_offset = Eigen::Vector3d::Zero();
  /// Whether floor and unit come from the file. False: from the reader.
  bool has_floor = true;
  /// Whether the recorded body had another shape than ours.
  bool other_shape = false;
  /// Whether its angles have a unit, which --angles may state.
  bool has_angles = false;
};

/// Turns Y up, sets the unit, puts the body on the floor if it certainly is not, and notes what
/// does not move or bends impossibly. Throws Error(kInvalidArgument) for `reading.up`.
Motion Settle(FileMotion file, const MotionReading& reading);

/// The share of its frames with an impossible bend (motion/pose_faults.h), 0 to 1, and a fault of
/// the first of these.
double ShareOfFaults(const Skeleton& skeleton, const Motion& motion,
                     std::string* example = nullptr);

}  // namespace choreo
