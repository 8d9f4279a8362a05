#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace choreo {

/// A naming of SMPL's joints in files.
enum class JointNames : uint8_t {
  kSmpl,     ///< pelvis, left_hip, ...
  kMixamo,   ///< mixamorig:Hips, mixamorig:LeftUpLeg, ...
  kHumanIk,  ///< Hips, LeftUpLeg, ...: MotionBuilder's and Maya's
  kUnreal,   ///< pelvis, thigh_l, ...: Unreal Engine's mannequin
};

inline constexpr std::array kAllJointNames = {JointNames::kSmpl, JointNames::kMixamo,
                                              JointNames::kHumanIk, JointNames::kUnreal};

/// "smpl", "mixamo", "humanik" or "ue".
std::string_view NameOf(JointNames names);
/// The inverse of NameOf. Throws Error(kInvalidArgument), whose field is `field`, naming the four.
JointNames ParseJointNames(std::string_view text, const std::string& field);

/// The name of SMPL's `joint` in this naming. Other joints keep their names.
std::string JointName(const std::string& joint, JointNames names);

}  // namespace choreo
