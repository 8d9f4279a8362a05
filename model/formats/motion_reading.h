#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "model/fit/find_bones.h"

namespace choreo {

/// How a motion file is to be read, where it does not say so itself or says it wrongly. All is
/// optional.
struct MotionReading {
  /// The file's axis that points up, as in "z" or "-y"; empty: as its format has it, unless the
  /// body would lie.
  std::string up = {};
  double scale = 0;  ///< metres in the file's unit of length; 0: as its format has it
  double fps = 0;    ///< for a file that states no rate; 0: 30
  std::string animation =
      {};                 ///< of a glTF: its name, or its number from 0 on; empty: one that moves
  std::string body = {};  ///< of several: its name, or its number from 0 on; empty: the first
  std::vector<BoneChoice> bones = {};  ///< which node is which bone, before what their names say
  /// Where it is wanted: what was read otherwise than the file says, and what looks wrong, a line
  /// each.
  std::vector<std::string>* notes = nullptr;

  /// Whether it says which bones are read.
  bool chooses() const { return !bones.empty() || !body.empty(); }
  /// Throws Error(kInvalidArgument) where --body is given, for a file of one.
  void RefuseBody() const;
  void Note(const std::string& text) const {
    if (notes != nullptr) notes->push_back(text);
  }
  /// That a file states no rate, and is read at this one.
  void NoteRate(double taken) const;
};

/// The number that `text` is, if it is one and below `limit`.
std::optional<size_t> NumberBelow(const std::string& text, size_t limit);

/// Of several bodies that which --body names: by its name, if no other has that, or by its number.
/// Throws Error(kInvalidArgument) whose field is --body.
size_t ChooseBody(const std::string& body, const std::vector<std::string>& names);

/// `0 "A:Hips", 1 "B:Hips"`, for messages.
std::string ListBodies(const std::vector<std::string>& names);

/// "y" → (0, 1, 0), "-z" → (0, 0, -1). Throws Error(kInvalidArgument) whose field is --up.
Eigen::Vector3d ParseUp(const std::string& up);

/// The inverse.
std::string UpName(const Eigen::Vector3d& up);

/// The shortest turn that leads from `up` to Y.
Eigen::Matrix3d TurnToYUp(const Eigen::Vector3d& up);

}  // namespace choreo
