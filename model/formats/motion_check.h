#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "model/formats/motion_reading.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// What is plausible of a motion that was read, in one place for all formats. What is certainly
/// wrong is mended, and said; what may be wrong is said with the option that mends it.
namespace choreo {

/// A motion in the axes and units of its file.
struct FileMotion {
  Skeleton skeleton;
  Motion motion;
  /// Of the file, by its format; what the motion's own trunk says may be another.
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  /// Along which the rig's rest pose stands, if it has one that does.
  std::optional<Eigen::Vector3d> rest_up = {};
  /// Where joint 0 stands, seen from what the file calls its place: its own metres and axes.
  Eigen::Vector3d root_offset = Eigen::Vector3d::Zero();
  /// Whether floor and unit are the file's. False: the reader made them.
  bool has_floor = true;
  /// Whether the recorded body had another shape than ours.
  bool other_shape = false;
};

/// Turns Y up, sets the unit, puts the body on the floor where it certainly is not, and tells of
/// what does not move or bends as no body does. Throws Error(kInvalidArgument) for `reading.up`.
Motion Settle(FileMotion file, const MotionReading& reading);

/// Of its frames, those in which a joint is bent as no body can (motion/pose_faults.h), 0 to 1; of
/// the first of these one fault.
double ShareOfFaults(const Skeleton& skeleton, const Motion& motion,
                     std::string* example = nullptr);

}  // namespace choreo
