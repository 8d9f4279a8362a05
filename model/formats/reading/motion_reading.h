#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "model/fit/bones/find_bones.h"

namespace choreo {

/// Says what a motion file leaves open or states wrongly. All members are optional.
struct MotionReading {
  /// The file's axis that points up, such as "z" or "-y"; empty: the format's, unless the body
  /// would then lie.
  std::string up = {};
  double scale = 0;  ///< metres per unit of the file; 0: the format's unit
  double fps = 0;    ///< for a file that states no rate or several; 0: 30
  /// The unit of angles, "degrees" or "radians"; empty: the format's, unless the body would then
  /// bend impossibly.
  std::string angles = {};
  /// The glTF animation's name, or its number from 0 on; empty: one that moves.
  std::string animation = {};
  /// The name of one of several bodies, or its number from 0 on; empty: the first.
  std::string body = {};
  std::vector<BoneChoice> bones = {};  ///< assigned bones, which override names
  /// If given, receives one line for each deviation from the file and for each suspicious fact.
  std::vector<std::string>* notes = nullptr;

  /// Whether bones, axes or units are chosen. Then even our own files are read like any rig's.
  bool chooses() const {
    return !bones.empty() || !body.empty() || !up.empty() || scale > 0 || !angles.empty();
  }
  /// Throws Error(kInvalidArgument) if --body is given. Call it for files with one body.
  void RefuseBody() const;
  void Note(const std::string& text) const {
    if (notes != nullptr) notes->push_back(text);
  }
  /// Notes that a file states no rate and is read at `taken`, frames per second.
  void NoteRate(double taken) const;
};

/// The end of messages about unreadable arrays.
inline constexpr const char* kWriteArrays =
    "write rotations and places by numpy.savez(\"FILE.npz\", poses=..., trans=..., fps=...)";

/// Parses `text` as a number below `limit`. None for anything else.
std::optional<size_t> NumberBelow(const std::string& text, size_t limit);

/// The index of the body that --body chooses, by its name if unique, or by its number. Throws
/// Error(kInvalidArgument), whose field is --body, if there is none.
size_t ChooseBody(const std::string& body, const std::vector<std::string>& names);

/// Lists bodies for messages: `0 "A:Hips", 1 "B:Hips"`.
std::string ListBodies(const std::vector<std::string>& names);

/// Throws Error(kInvalidArgument), whose field is --angles, for an unknown unit of angles.
void CheckAngles(const std::string& angles);

/// Parses an axis: "y" is (0, 1, 0), "-z" is (0, 0, -1). Throws Error(kInvalidArgument), whose
/// field is --up, for anything else.
Eigen::Vector3d ParseUp(const std::string& up);

/// The inverse.
std::string UpName(const Eigen::Vector3d& up);

/// The shortest rotation from `up` to Y.
Eigen::Matrix3d TurnToYUp(const Eigen::Vector3d& up);

}  // namespace choreo
