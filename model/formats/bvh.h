#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/fit/position_clip.h"
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
};

struct BvhJoint {
  std::string name;  ///< an End Site is named after its parent + "_end"
  int parent = -1;   ///< -1 for the root; parents stand before their children
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< from the parent, file units
  /// In file order. Rotations apply in that order from left to right, R = R_first R_second R_third.
  /// A position channel replaces the offset's coordinate (which is what the authoring tools write,
  /// at the root and elsewhere).
  std::vector<BvhChannel> channels;
  bool end_site = false;
};

struct BvhFile {
  std::vector<BvhJoint> joints;
  double frame_time = 1.0 / 30;  ///< seconds
  Eigen::MatrixXd values;        ///< [channels of all joints, frames] file units and degrees

  int64_t frames() const { return values.cols(); }
  /// 1 / frame_time, taken as the whole number (or whole number x 1000/1001) that it is a rounding
  /// of.
  double fps() const;
  std::vector<std::string> JointNames() const;
};

/// Throws Error(kInvalidArgument) whose field is "NAME:LINE" and whose message names the token that
/// was found and what was expected. Refused are, besides other syntax errors: a second root, a
/// hierarchy without channels, a channel given twice, numbers that are not finite, fewer or more
/// values than the header states, a frame time outside 1e-5 to 10 s, lengths beyond 1e7 and angles
/// beyond 1000 radians (motion/pose_limits.h).
BvhFile ParseBvh(std::string_view text, const std::string& name);
/// As ParseBvh; Error(kNotFound) where the file cannot be opened.
BvhFile ReadBvh(const std::filesystem::path& path);

/// Six decimals. Throws Error(kInvalidArgument) where joints are out of order or `values` does not
/// have a row for every channel.
void WriteBvh(std::ostream& out, const BvhFile& file);
/// Error(kInternal) where the file cannot be written.
void WriteBvh(const std::filesystem::path& path, const BvhFile& file);

/// Global positions of all joints and end sites in one frame, [3, joints], file units.
Eigen::Matrix3Xd BvhPositions(const BvhFile& file, int64_t frame);

/// The whole file as joint positions in metres: what the fit takes. `metres_per_unit`: 0.01 for
/// centimetres.
PositionClip BvhToPositions(const BvhFile& file, double metres_per_unit);

/// Ours: the skeleton's names, rest offsets in centimetres, 6 channels at the root, ZXY Euler
/// angles everywhere, an End Site at each leaf. The root's offset is zero, so that readers that add
/// it to the position channels and readers that do not agree. Euler angles are continuous in time
/// where they can be. Throws Error(kInvalidArgument) for a motion without frames or of another
/// joint count.
BvhFile MotionToBvh(const Skeleton& skeleton, const Motion& motion);

/// The file's own skeleton (own_skeleton.h), lengths taken for centimetres; none where a joint
/// stands above its root.
std::optional<Skeleton> BvhSkeleton(const BvhFile& file);

/// Whether a file has exactly this skeleton: names, parents and rest offsets (1 mm, in
/// centimetres).
bool IsBvhOf(const BvhFile& file, const Skeleton& skeleton);

/// The inverse of MotionToBvh, for files of which IsBvhOf holds; throws Error(kInvalidArgument) for
/// others.
Motion BvhToMotion(const BvhFile& file, const Skeleton& skeleton);

}  // namespace choreo
