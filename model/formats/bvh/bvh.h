#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/fit/rig_motion.h"
#include "model/fit/sources/position_clip.h"
#include "model/formats/bvh/joint_names.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Biovision hierarchy (BVH) files of any tool: channels in any order, position channels at any
/// joint, End Sites. Angles in files are degrees; lengths have any unit, mostly centimetres. All
/// functions but file access are pure.
namespace choreo {

enum class BvhChannel : uint8_t {
  kXPosition,
  kYPosition,
  kZPosition,
  kXRotation,
  kYRotation,
  kZRotation,
  kXScale,  ///< read but ignored: bones keep their lengths
  kYScale,
  kZScale,
};

/// Names in files, indexed by BvhChannel.
inline constexpr std::string_view kBvhChannelNames[] = {"Xposition", "Yposition", "Zposition",
                                                        "Xrotation", "Yrotation", "Zrotation",
                                                        "Xscale",    "Yscale",    "Zscale"};

struct BvhJoint {
  std::string name;  ///< an End Site has its parent's name + "_end"
  int parent = -1;   ///< -1 for a root; parents precede their children
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< from the parent, file units
  /// The channels in file order. Rotations multiply in this order: R = R_first R_second R_third. A
  /// position channel replaces the offset's coordinate, at the root and elsewhere, as authoring
  /// tools write it.
  std::vector<BvhChannel> channels;
  bool end_site = false;
  /// Whether position channels are added to the offset; they are if they are nearly 0 in all
  /// frames.
  bool adds = false;
};

struct BvhFile {
  std::vector<BvhJoint> joints;         ///< each followed by its descendants
  double frame_time = 1.0 / 30;         ///< seconds
  bool states_rate = true;              ///< false: the file's frame time was 0
  Eigen::MatrixXd values;               ///< [channels of all joints, frames] file units and degrees
  std::vector<std::string> notes = {};  ///< deviations from the file's content, for users

  int64_t frames() const { return values.cols(); }
  /// 1 / frame_time, with the file's rounding undone (WholeRate).
  double fps() const;
  std::vector<std::string> JointNames() const;
};

/// Parses as leniently as other tools: UTF-8 or UTF-16, comments after # and //, "Frames:30",
/// "EndSite", decimal commas, several roots, a frame time of 0 (no rate) or of 4 and more
/// (milliseconds), and a wrong count of whole rows, which adds a note. Throws
/// Error(kInvalidArgument) whose field is "NAME:LINE" and whose message names the token found and
/// what was expected. Besides syntax errors, refuses a hierarchy without channels, a duplicate
/// channel, numbers that are not finite, partial rows, rows of another length than the channels, a
/// frame time outside 1e-5 to 4 s, lengths beyond 1e7 and angles beyond 1000 radians
/// (motion/pose/pose_limits.h).
BvhFile ParseBvh(std::string_view text, const std::string& name);
/// Throws what ParseBvh throws, and Error(kNotFound) if the file cannot be opened.
BvhFile ReadBvh(const std::filesystem::path& path);

/// The file's text, with six decimals.
std::string BvhText(const BvhFile& file);
/// Writes BvhText to a file. Throws Error(kInternal) if it cannot be written.
void WriteBvh(const std::filesystem::path& path, const BvhFile& file);

/// Global positions and rotations of all joints and end sites in one frame, in file units.
RigPlacement PlaceBvh(const BvhFile& file, int64_t frame);
/// PlaceBvh for the rest pose: from the offsets alone.
RigPlacement PlaceBvhAtRest(const BvhFile& file);

/// Global positions of all joints and end sites in one frame, [3, joints], file units.
Eigen::Matrix3Xd BvhPositions(const BvhFile& file, int64_t frame);

/// The whole file as joint positions in metres, for fitting. `metres_per_unit`: 0.01 for
/// centimetres.
PositionClip BvhToPositions(const BvhFile& file, double metres_per_unit);

inline constexpr double kCentimetres = 100, kMetres = 1;  ///< units per metre

/// The layout of the files that we write.
struct BvhLayout {
  JointNames names = JointNames::kSmpl;
  double units_per_metre = kCentimetres;
};

/// Converts a motion to our layout: rest offsets, 6 channels at the root, ZXY Euler angles at all
/// joints, an End Site at each leaf. The root's offset is the hips' height at rest, so a body at
/// rest stands on the floor; position channels replace it. Euler angles are continuous in time
/// (euler_angles.h). Throws Error(kInvalidArgument) for a motion without frames or with another
/// joint count, and for a skeleton other than SMPL's with names other than its own.
BvhFile MotionToBvh(const Skeleton& skeleton, const Motion& motion, const BvhLayout& layout = {});

/// The file's own skeleton (OwnSkeleton). Its unit is centimetres, or metres if the body is less
/// than 5 units large. None if a joint is above the skeleton's root.
std::optional<Skeleton> BvhSkeleton(const BvhFile& file);

/// The inverse of MotionToBvh for any layout. None unless the file has exactly this skeleton:
/// names, parents and rest offsets (kSameBone).
std::optional<Motion> BvhToMotion(const BvhFile& file, const Skeleton& skeleton);

}  // namespace choreo
