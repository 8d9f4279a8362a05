#include "model/formats/bvh/joint_names.h"

#include <algorithm>

#include "model/core/error.h"
#include "model/fit/bones/human_bones.h"

namespace choreo {

std::string_view NameOf(JointNames names) {
  constexpr std::string_view kNames[] = {"smpl", "mixamo", "humanik", "ue"};
  return kNames[static_cast<size_t>(names)];
}

JointNames ParseJointNames(std::string_view text, const std::string& field) {
  const auto* found = std::ranges::find(kAllJointNames, text, NameOf);
  if (found != kAllJointNames.end()) return *found;
  throw InvalidArgument(field,
                        "\"" + std::string(text) + "\" is none of smpl, mixamo, humanik, ue");
}

std::string JointName(const std::string& joint, JointNames names) {
  if (names == JointNames::kSmpl) return joint;
  const std::string name =
      NameInRig(names == JointNames::kUnreal ? kUnrealRig : kHumanIkRig, joint);
  if (name.empty()) return joint;
  return names == JointNames::kMixamo ? "mixamorig:" + name : name;
}

}  // namespace choreo
