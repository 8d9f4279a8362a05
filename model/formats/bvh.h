#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/fit/position_clip.h"
#include "model/fit/rig_motion.h"
#include "model/formats/joint_names.h"
#include "model/motion/motion.h"
#include "model/motion/skeleton.h"

/// Biovision hierarchy files, as written by any tool: channels in any order, position channels at
/// any joint, End Sites. Angles in files are degrees, lengths whatever their author chose (mostly
/// centimetres). All functions are pure.
namespace choreo {

enum class BvhChannel : uint8_t {
  kXPosition,
  kYPosition,
  kZPosition,
  kXRotation,
  kYRotation,
  kZRotation,
  kXScale,  ///< read and let be: bones keep their lengths
  kYScale,
  kZScale,
};

/// As files call them, in that order.
inline constexpr std::string_view kBvhChannelNames[] = {"Xposition", "Yposition", "Zposition",
                                                        "Xrotation", "Yrotation", "Zrotation",
                                                        "Xscale",    "Yscale",    "Zscale"};

struct BvhJoint {
  std::string name;  ///< an End Site is named after its parent + "_end"
  int parent = -1;   ///< -1 for a root; parents stand before their children
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< from the parent, file units
  /// In file order. Rotations apply in that order from left to right, R = R_first R_second R_third.
  /// A position channel replaces the offset's coordinate (which is what the authoring tools write,
  /// at the root and elsewhere).
  std::vector<BvhChannel> channels;
  bool end_site = false;
  /// Its position channels are 0, or nearly, in all frames: they are added to the offset.
  bool adds = false;
};

struct BvhFile {
  std::vector<BvhJoint> joints;         ///< behind each all that hangs from it
  double frame_time = 1.0 / 30;         ///< seconds
  bool states_rate = true;              ///< false: the file's frame time was 0
  Eigen::MatrixXd values;               ///< [channels of all joints, frames] file units and degrees
  std::vector<std::string> notes = {};  ///< what was read otherwise than the file says

  int64_t frames() const { return values.cols(); }
  /// 1 / frame_time, taken as the whole number (or whole number x 1000/1001) that it is a rounding
  /// of.
  double fps() const;
  std::vector<std::string> JointNames() const;
};

/// As lenient as the tools around: UTF-8 or UTF-16, comments behind # and //, "Frames:30",
/// "EndSite", decimal commas, a frame time of 0, which states no rate, one of 4 and more, which is
/// in milliseconds, and more or fewer whole rows than the header counts, which are noted; several
/// roots. Throws Error(kInvalidArgument) whose field is
/// "NAME:LINE" and whose message names the token that was found and what was expected. Refused are,
/// besides other syntax errors: a hierarchy without channels, a channel given twice,
/// numbers that are not finite, half a row, rows of another length than the channels, a frame time
/// outside 1e-5 to 4 s, lengths beyond 1e7 and angles beyond 1000 radians (motion/pose_limits.h).
BvhFile ParseBvh(std::string_view text, const std::string& name);
/// As ParseBvh; Error(kNotFound) where the file cannot be opened.
BvhFile ReadBvh(const std::filesystem::path& path);

/// Six decimals.
std::string BvhText(const BvhFile& file);
/// The same in a file. Error(kInternal) where it cannot be written.
void WriteBvh(const std::filesystem::path& path, const BvhFile& file);

/// Global places and turns of all joints and end sites in one frame, file units.
RigPlacement PlaceBvh(const BvhFile& file, int64_t frame);
/// The same of the offsets alone.
RigPlacement PlaceBvhAtRest(const BvhFile& file);

/// Global positions of all joints and end sites in one frame, [3, joints], file units.
Eigen::Matrix3Xd BvhPositions(const BvhFile& file, int64_t frame);

/// The whole file as joint positions in metres: what the fit takes. `metres_per_unit`: 0.01 for
/// centimetres.
PositionClip BvhToPositions(const BvhFile& file, double metres_per_unit);

inline constexpr double kCentimetres = 100, kMetres = 1;  ///< units in a metre

/// How a file of ours is written.
struct BvhLayout {
  JointNames names = JointNames::kSmpl;
  double units_per_metre = kCentimetres;
};

/// Ours: rest offsets, 6 channels at the root, ZXY Euler angles everywhere, an End Site at each
/// leaf. The root's offset is the height of the hips at rest, which its position channels replace:
/// a body at rest stands on the floor. Euler angles are continuous in time where they can be.
/// Throws Error(kInvalidArgument) for a motion without frames or of another joint count, and for
/// another skeleton than SMPL's by other names than its own.
BvhFile MotionToBvh(const Skeleton& skeleton, const Motion& motion, const BvhLayout& layout = {});

/// The file's own skeleton (own_skeleton.h), in centimetres, or in metres where it is less than 5
/// units large; none where a joint stands above its root.
std::optional<Skeleton> BvhSkeleton(const BvhFile& file);

/// The inverse of MotionToBvh, whatever the layout; none unless the file has exactly this skeleton:
/// names, parents and rest offsets (kSameBone).
std::optional<Motion> BvhToMotion(const BvhFile& file, const Skeleton& skeleton);

}  // namespace choreo
