#include "client/authoring/keys/key_numbers.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "client/authoring/fields/json_fields.h"
#include "model/fit/retarget.h"
#include "model/formats/arrays/amass_npz.h"
#include "model/formats/containers/npz.h"
#include "model/motion/pose/pose_limits.h"

namespace choreo::authoring {
namespace {

using client::KeyPose;
using nlohmann::json;

Eigen::Vector3d Vector(const json& value, const std::string& field) {
  if (!value.is_array() || value.size() != 3) {
    throw InvalidArgument(field, Shown(value) + " is not a list of 3 numbers");
  }
  Eigen::Vector3d out;
  for (int i = 0; i < 3; ++i) {
    out[i] = JsonNumber(value[static_cast<size_t>(i)], field + "[" + std::to_string(i) + "]");
  }
  return out;
}

/// Members that contain a pose in numbers.
constexpr const char* kPoseMembers[] = {"rotations",  "root_position", "smpl_poses",
                                        "smpl_trans", "poses",         "trans"};

void CheckAngles(const Eigen::Matrix3Xd& rotations, const std::string& field) {
  for (Eigen::Index joint = 0; joint < rotations.cols(); ++joint) {
    const double angle = rotations.col(joint).norm();
    if (angle > kMaxRotation) {
      std::ostringstream message;
      message << angle << " rad exceeds 2π; angles are in radians";
      throw InvalidArgument(field + "[" + std::to_string(joint) + "]", message.str());
    }
  }
}

Eigen::Matrix3Xd Rotations(const json& value, const std::string& field, int joints) {
  if (!value.is_array() || static_cast<int>(value.size()) != joints) {
    const std::string has =
        value.is_array() ? "has " + std::to_string(value.size()) + " entries" : "is not a list";
    throw InvalidArgument(field,
                          has + ", not one for each of the " + std::to_string(joints) + " joints");
  }
  Eigen::Matrix3Xd out(3, joints);
  for (int joint = 0; joint < joints; ++joint) {
    const std::string path = field + "[" + std::to_string(joint) + "]";
    out.col(joint) = Vector(value[static_cast<size_t>(joint)], path);
  }
  CheckAngles(out, field);
  return out;
}

// Returns the numbers of a list, or of a list of lists.
std::vector<double> Flatten(const json& value, const std::string& field) {
  std::vector<double> out;
  const auto at = [](size_t index) { return "[" + std::to_string(index) + "]"; };
  for (size_t i = 0; i < value.size(); ++i) {
    const json& inner = value[i];
    if (!inner.is_array()) {
      out.push_back(JsonNumber(inner, field + at(i)));
      continue;
    }
    for (size_t j = 0; j < inner.size(); ++j)
      out.push_back(JsonNumber(inner[j], field + at(i) + at(j)));
  }
  return out;
}

// Reads a pose written like one frame of an SMPL motion file, under that format's names.
KeyPose ReadSmplKey(const json& value, const std::string& field, const std::string& poses,
                    const std::string& trans, const Skeleton& skeleton) {
  KeyPose key;
  key.mask.root_position = value.contains(trans);
  NpzArchive file;
  const auto add = [&](const std::string& name) {
    if (!value[name].is_array()) {
      throw InvalidArgument(field + "." + name, Shown(value[name]) + " is not a list");
    }
    std::vector<double> numbers = Flatten(value[name], field + "." + name);
    // Checks the numbers as given: converting them to our axes would hide an absurd angle.
    if (name == poses && numbers.size() % 3 == 0) {
      CheckAngles(Eigen::Map<const Eigen::Matrix3Xd>(numbers.data(), 3, std::ssize(numbers) / 3),
                  field + "." + name);
    }
    const auto count = static_cast<int64_t>(numbers.size());
    file.SetArray(name, {{1, count}, std::move(numbers)});
  };
  add(poses);
  if (key.mask.root_position) {
    add(trans);
  } else {
    file.SetArray(trans, {{1, 3}, std::vector<double>(3, 0.0)});
  }
  file.SetArray("mocap_framerate", {{}, std::vector<double>{1}});
  try {
    key.pose = ReadSmplMotion(file).frames[0];
  } catch (const Error& error) {
    throw InvalidArgument(field, error.what());
  }
  try {
    key.pose = Retarget(Skeleton::Smpl24(), key.pose, skeleton);
  } catch (const Error& error) {
    throw InvalidArgument(field + "." + poses, std::string("is a pose of SMPL: ") + error.what());
  }
  return key;
}

}  // namespace

bool HasNumbers(const json& value) {
  return std::ranges::any_of(kPoseMembers, [&](const char* name) { return value.contains(name); });
}

void RefuseNumbers(const json& value, const std::string& field) {
  for (const char* member : kPoseMembers) {
    if (!value.contains(member)) continue;
    throw InvalidArgument(field + "." + member, "cannot be combined with pose");
  }
}

KeyPose ReadNumbers(const json& value, const std::string& field, const Skeleton& skeleton) {
  struct Names {
    const char *rotations, *position;
  };
  static constexpr Names kNames[] = {
      {"rotations", "root_position"}, {"smpl_poses", "smpl_trans"}, {"poses", "trans"}};
  const Names* found = nullptr;
  for (const Names& names : kNames) {
    if (!value.contains(names.rotations)) {
      if (value.contains(names.position)) {
        throw InvalidArgument(field + "." + names.rotations,
                              std::string("is missing beside ") + names.position);
      }
      continue;
    }
    if (found) {
      throw InvalidArgument(field + "." + names.rotations,
                            std::string("cannot be combined with ") + found->rotations);
    }
    found = &names;
  }
  if (!found) throw InvalidArgument(field + ".rotations", "is missing, and so is pose");
  if (found != kNames)
    return ReadSmplKey(value, field, found->rotations, found->position, skeleton);
  KeyPose key;
  key.pose.rotations = Rotations(value["rotations"], field + ".rotations", skeleton.joints());
  key.mask.root_position = value.contains("root_position");
  if (key.mask.root_position)
    key.pose.root_position = Vector(value["root_position"], field + ".root_position");
  return key;
}

}  // namespace choreo::authoring
