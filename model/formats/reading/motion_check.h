#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "model/formats/reading/motion_reading.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Checks motions of all formats for plausibility. Corrects errors that are certain, with a note;
/// notes possible errors with the option that corrects them.
namespace choreo {

/// A motion in the axes and units of its file.
struct FileMotion {
  Skeleton skeleton;
  Motion motion;
  /// The up axis of the file's format. The motion's trunk may show another.
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  /// The axis along which the rig's rest pose stands, if it stands.
  std::optional<Eigen::Vector3d> rest_up = {};
  /// Position of joint 0 relative to the file's root position, metres, in the file's axes.
  Eigen::Vector3d root_offset = Eigen::Vector3d::Zero();
  /// Whether floor and unit come from the file, not from the reader.
  bool has_floor = true;
  /// Whether the recorded body had another shape than ours.
  bool other_shape = false;
  /// Whether the file's angles have a unit, which --angles can override.
  bool has_angles = false;
};

/// Turns the motion Y up, converts its unit to metres, and puts a body that certainly is off the
/// floor on it. Notes motions that stand still or bend impossibly. Throws Error(kInvalidArgument)
/// for `reading.up`.
Motion CorrectMotion(FileMotion file, const MotionReading& reading);

/// The share of frames with an impossible bend (motion/pose/pose_faults.h), 0 to 1. `example`, if
/// given, receives a fault of the first such frame.
double ShareOfFaults(const Skeleton& skeleton, const Motion& motion,
                     std::string* example = nullptr);

}  // namespace choreo
