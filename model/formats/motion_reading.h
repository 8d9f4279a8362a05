#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "model/fit/find_bones.h"

namespace choreo {

/// Options for reading a motion file that leaves something open or states it wrongly. All are
/// optional.
struct MotionReading {
  /// The file's axis that points up, such as "z" or "-y"; empty: that of its format, unless the
  /// body would lie.
  std::string up = {};
  double scale = 0;  ///< metres per unit of the file; 0: that of its format
  double fps = 0;    ///< for a file that states no rate, or several; 0: 30
  /// The unit of its angles, "degrees" or "radians"; empty: that of its format, unless the body
  /// would bend impossibly.
  std::string angles = {};
  /// The glTF animation's name, or its number from 0 on; empty: one that moves.
  std::string animation = {};
  /// The name of one of several bodies, or its number from 0 on; empty: the first.
  std::string body = {};
  std::vector<BoneChoice> bones = {};  ///< which node is which bone; overrides their names
  /// If given, receives one line for each deviation from the file and for each thing that looks
  /// wrong.
  std::vector<std::string>* notes = nullptr;

  /// Whether it chooses bones or their axes; then not even our own files are read unchanged.
  bool chooses() const {
    return !bones.empty() || !body.empty() || !up.empty() || scale > 0 || !angles.empty();
  }
  /// Throws Error(kInvalidArgument) if --body is given; call for files with one body.
  void RefuseBody() const;
  void Note(const std::string& text) const {
    if (notes != nullptr) notes->push_back(text);
  }
  /// Notes that a file states no rate and is read at this one.
  void NoteRate(double taken) const;
};

/// Describes readable arrays for messages.
inline constexpr const char* kWriteArrays =
    "write rotations and places by numpy.savez(\"FILE.npz\", poses=..., trans=..., fps=...)";

/// `text` as a number, if it is one and below `limit`.
std::optional<size_t> NumberBelow(const std::string& text, size_t limit);

/// The body that --body chooses, by its name if unique or by its number. Throws
/// Error(kInvalidArgument) whose field is --body.
size_t ChooseBody(const std::string& body, const std::vector<std::string>& names);

/// `0 "A:Hips", 1 "B:Hips"`, for messages.
std::string ListBodies(const std::vector<std::string>& names);

/// Throws Error(kInvalidArgument), whose field is --angles, for an unknown unit of angles.
void CheckAngles(const std::string& angles);

/// "y" → (0, 1, 0), "-z" → (0, 0, -1). Throws Error(kInvalidArgument) whose field is --up.
Eigen::Vector3d ParseUp(const std::string& up);

/// The inverse.
std::string UpName(const Eigen::Vector3d& up);

/// The shortest turn that leads from `up` to Y.
Eigen::Matrix3d TurnToYUp(const Eigen::Vector3d& up);

}  // namespace choreo
