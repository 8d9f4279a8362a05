#include "model/motion/skeleton_json.h"

#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "model/core/files/json_limits.h"

namespace choreo {
namespace {

using nlohmann::json;

Skeleton Read(const json& object) {
  Skeleton skeleton;
  object.at("name").get_to(skeleton.name);
  object.at("joint_names").get_to(skeleton.joint_names);
  object.at("parents").get_to(skeleton.parents);
  const auto& offsets = object.at("offsets_m");
  skeleton.offsets.resize(3, std::ssize(offsets));
  for (size_t joint = 0; joint < offsets.size(); ++joint) {
    for (size_t axis = 0; axis < 3; ++axis)
      offsets.at(joint).at(axis).get_to(skeleton.offsets(axis, joint));
  }
  object.at("pelvis_height_m").get_to(skeleton.pelvis_height);
  const auto pair = [&](const char* key, int* left, int* right) {
    object.at(key).at(0).get_to(*left);
    object.at(key).at(1).get_to(*right);
  };
  pair("hips", &skeleton.left_hip, &skeleton.right_hip);
  pair("knees", &skeleton.left_knee, &skeleton.right_knee);
  pair("shoulders", &skeleton.left_shoulder, &skeleton.right_shoulder);
  pair("elbows", &skeleton.left_elbow, &skeleton.right_elbow);
  object.at("feet").get_to(skeleton.feet);
  return skeleton;
}

}  // namespace

std::string SkeletonToJson(const Skeleton& skeleton) {
  json offsets = json::array();
  for (const auto offset : skeleton.offsets.colwise())
    offsets.push_back({offset.x(), offset.y(), offset.z()});
  return json{{"name", skeleton.name},
              {"joint_names", skeleton.joint_names},
              {"parents", skeleton.parents},
              {"offsets_m", offsets},
              {"pelvis_height_m", skeleton.pelvis_height},
              {"hips", {skeleton.left_hip, skeleton.right_hip}},
              {"knees", {skeleton.left_knee, skeleton.right_knee}},
              {"shoulders", {skeleton.left_shoulder, skeleton.right_shoulder}},
              {"elbows", {skeleton.left_elbow, skeleton.right_elbow}},
              {"feet", skeleton.feet}}
      .dump();
}

Skeleton SkeletonFromJson(const std::string& text) {
  Skeleton skeleton;
  try {
    const json object = json::parse(text);
    CheckJsonNumbers(object, "skeleton");
    skeleton = Read(object);
  } catch (const json::exception& error) {
    throw InvalidArgument("skeleton", std::string("can't be read: ") + error.what());
  }
  skeleton.Check();
  return skeleton;
}

}  // namespace choreo
