#include "client/authoring/keys/key_joints.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/placing.h"
#include "client/authoring/keys/pose_library.h"
#include "model/core/error.h"
#include "model/fit/retarget.h"
#include "model/motion/kinematics/joint_angles.h"

namespace choreo::authoring {
namespace {

using nlohmann::json;

std::vector<double> NumbersOf(const json& value, const std::string& field) {
  if (!value.is_array()) return {JsonNumber(value, field)};
  std::vector<double> numbers;
  for (size_t i = 0; i < value.size(); ++i)
    numbers.push_back(JsonNumber(value[i], field + "[" + std::to_string(i) + "]"));
  return numbers;
}

/// The joints with this name: one joint, or a whole limb from the hip or shoulder on.
std::vector<int> Named(const std::string& name, const Skeleton& skeleton,
                       const std::string& field) {
  std::vector<int> roots;
  if (name == "arms" || name == "left_arm") roots.push_back(skeleton.left_shoulder);
  if (name == "arms" || name == "right_arm") roots.push_back(skeleton.right_shoulder);
  if (name == "legs" || name == "left_leg") roots.push_back(skeleton.left_hip);
  if (name == "legs" || name == "right_leg") roots.push_back(skeleton.right_hip);
  if (roots.empty()) return {RequireJoint(skeleton, name, field)};
  std::vector<bool> below(static_cast<size_t>(skeleton.joints()), false);
  std::vector<int> joints;
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const int parent = skeleton.parents[static_cast<size_t>(joint)];
    const bool root = std::find(roots.begin(), roots.end(), joint) != roots.end();
    if (!root && (parent < 0 || !below[static_cast<size_t>(parent)])) continue;
    below[static_cast<size_t>(joint)] = true;
    joints.push_back(joint);
  }
  return joints;
}

std::vector<bool> Mask(const json& names, const std::string& field, const Skeleton& skeleton) {
  if (names.empty()) throw InvalidArgument(field, Shown(names) + " is not a list of joint names");
  std::vector<bool> mask(static_cast<size_t>(skeleton.joints()), false);
  for (const json& name : names) {
    if (!name.is_string()) throw InvalidArgument(field, Shown(name) + " is not a joint's name");
    for (const int joint : Named(name.get<std::string>(), skeleton, field))
      mask[static_cast<size_t>(joint)] = true;
  }
  return mask;
}

}  // namespace

client::KeyPose ReadNamedPose(const json& value, const std::string& field,
                              const Skeleton& skeleton) {
  const json& name = value["pose"];
  if (!name.is_string()) throw InvalidArgument(field + ".pose", Shown(name) + " is not a name");
  client::KeyPose key;
  try {
    key.pose =
        Retarget(Skeleton::Smpl24(), FindLibraryPose(name.get<std::string>()).pose, skeleton);
  } catch (const Error& error) {
    throw InvalidArgument(field + ".pose", error.what());
  }
  const Placing placing = ReadPlacing(value, field);
  key.mask.root_position = placing.place.has_value();
  key.pose = placing.From(GroundFrame()).ToWorld(key.pose);
  return key;
}

void ReadJoints(const json& joints, const std::string& field, const Skeleton& skeleton,
                client::KeyPose* key) {
  if (!joints.is_object()) {
    if (!joints.is_array())
      throw InvalidArgument(field, Shown(joints) + " is not a list of joint names");
    key->mask.joints = Mask(joints, field, skeleton);
    return;
  }
  if (joints.empty()) throw InvalidArgument(field, "names no joint");
  for (const auto& [name, degrees] : joints.items()) {
    const int joint = RequireJoint(skeleton, name, field);
    const std::string at = field + "." + name;
    key->pose.rotations.col(joint) =
        RotationFromDegrees(skeleton, joint, NumbersOf(degrees, at), at);
  }
}

void LimitToNamed(const json& value, const Skeleton& skeleton, client::KeyPose* key) {
  key->mask.root_position = value.contains("place");
  key->mask.joints.assign(static_cast<size_t>(skeleton.joints()), false);
  key->mask.joints[0] = value.contains("facing");
  for (const auto& [name, degrees] : value["joints"].items())
    key->mask.joints[static_cast<size_t>(skeleton.Find(name))] = true;
}

}  // namespace choreo::authoring
