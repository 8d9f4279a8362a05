#include "model/formats/joint_names.h"

#include <algorithm>
#include <iterator>

#include "model/core/error.h"

namespace choreo {
namespace {

struct Names {
  std::string_view smpl, humanik, unreal;
};

/// Of the joints in the middle, and of those on the left: the right has its own by its prefix or
/// suffix. SMPL's hand is where the fingers begin.
constexpr Names kMiddle[] = {
    {"pelvis", "Hips", "pelvis"},     {"spine1", "Spine", "spine_01"},
    {"spine2", "Spine1", "spine_02"}, {"spine3", "Spine2", "spine_03"},
    {"neck", "Neck", "neck_01"},      {"head", "Head", "head"},
};
constexpr Names kSide[] = {
    {"hip", "UpLeg", "thigh"},
    {"knee", "Leg", "calf"},
    {"ankle", "Foot", "foot"},
    {"foot", "ToeBase", "ball"},
    {"collar", "Shoulder", "clavicle"},
    {"shoulder", "Arm", "upperarm"},
    {"elbow", "ForeArm", "lowerarm"},
    {"wrist", "Hand", "hand"},
    {"hand", "HandMiddle1", "middle_01"},
};

template <size_t kCount>
const Names* Find(const Names (&names)[kCount], std::string_view joint) {
  const Names* found = std::ranges::find(names, joint, &Names::smpl);
  return found == std::end(names) ? nullptr : found;
}

}  // namespace

std::string_view NameOf(JointNames names) {
  switch (names) {
    case JointNames::kSmpl:
      return "smpl";
    case JointNames::kMixamo:
      return "mixamo";
    case JointNames::kHumanIk:
      return "humanik";
    case JointNames::kUnreal:
      return "ue";
  }
  return "";
}

JointNames ParseJointNames(std::string_view text, const std::string& field) {
  const auto* found = std::ranges::find(kAllJointNames, text, NameOf);
  if (found != kAllJointNames.end()) return *found;
  throw InvalidArgument(field,
                        "\"" + std::string(text) + "\" is none of smpl, mixamo, humanik, ue");
}

std::string JointName(const std::string& joint, JointNames names) {
  if (names == JointNames::kSmpl) return joint;
  const bool left = joint.starts_with("left_"), right = joint.starts_with("right_");
  const Names* found = Find(kMiddle, joint);
  if (left || right) found = Find(kSide, std::string_view(joint).substr(left ? 5 : 6));
  if (!found) return joint;
  if (names == JointNames::kUnreal)
    return std::string(found->unreal) + (left ? "_l" : right ? "_r" : "");
  const std::string prefix = names == JointNames::kMixamo ? "mixamorig:" : "";
  return prefix + (left ? "Left" : right ? "Right" : "") + std::string(found->humanik);
}

}  // namespace choreo
