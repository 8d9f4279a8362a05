#include "client/authoring/keys/pose_file.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "client/authoring/fields/json_fields.h"
#include "client/authoring/keys/key_file.h"
#include "model/core/error.h"

namespace choreo::authoring {
namespace {

using nlohmann::json;

/// To 4 decimals, without "-0".
double Short(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

std::string VectorText(const Eigen::Vector3d& vector) {
  std::ostringstream text;
  const char* before = "[";
  for (const double value : vector) {
    text << before << Short(value);
    before = ", ";
  }
  text << "]";
  return text.str();
}

}  // namespace

std::string PoseFileText(const DescribedPose& pose, const Skeleton& skeleton) {
  const client::KeyPose& key = pose.key;
  std::ostringstream text;
  text << "{\n";
  if (!pose.description.empty())
    text << "  \"description\": " << json(pose.description).dump() << ",\n";
  if (!pose.tags.empty()) text << "  \"tags\": " << json(pose.tags).dump() << ",\n";
  text << "  \"keyframes\": [{\n    \"id\": " << json(key.id).dump()
       << ",\n    \"time\": " << json(key.time_s).dump() << ",\n";
  if (pose.hold_s > 0) text << "    \"hold\": " << json(Short(pose.hold_s)).dump() << ",\n";
  if (key.hit) text << "    \"hit\": " << json(*key.hit).dump() << ",\n";
  if (key.hands)
    text << "    \"hands\": \"" << kHandPoseNames[static_cast<size_t>(*key.hands)] << "\",\n";
  if (key.mask.root_position)
    text << "    \"root_position\": " << VectorText(key.pose.root_position) << ",\n";
  if (!key.mask.joints.empty()) {
    json names = json::array();
    for (int joint = 0; joint < skeleton.joints(); ++joint) {
      if (key.mask.Constrains(joint))
        names.push_back(skeleton.joint_names[static_cast<size_t>(joint)]);
    }
    text << "    \"joints\": " << names.dump() << ",\n";
  }
  text << "    \"rotations\": [";
  for (Eigen::Index joint = 0; joint < key.pose.rotations.cols(); ++joint)
    text << (joint == 0 ? "\n      " : ",\n      ") << VectorText(key.pose.rotations.col(joint));
  text << "\n    ]\n  }]\n}\n";
  return text.str();
}

DescribedPose ParsePoseFile(const std::string& text, const std::string& name,
                            const Skeleton& skeleton) {
  DescribedPose pose;
  pose.key = ParseKeyFile(text, name, skeleton).front();
  const json file = json::parse(text);
  const json& key = file["keyframes"][0];
  if (key.contains("hold")) pose.hold_s = JsonTime(key["hold"], name + ":keyframes[0].hold").amount;
  const auto require_text = [&](const json& value, const std::string& member) {
    if (!value.is_string() || value.get<std::string>().empty())
      throw InvalidArgument(name + ":" + member, Shown(value) + " is not a text");
    return value.get<std::string>();
  };
  if (file.contains("description"))
    pose.description = require_text(file["description"], "description");
  if (!file.contains("tags")) return pose;
  if (!file["tags"].is_array())
    throw InvalidArgument(name + ":tags", Shown(file["tags"]) + " is not a list");
  for (const json& tag : file["tags"]) pose.tags.push_back(require_text(tag, "tags"));
  return pose;
}

}  // namespace choreo::authoring
