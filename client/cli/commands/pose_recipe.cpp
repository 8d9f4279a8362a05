#include "client/cli/commands/pose_recipe.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "client/authoring/keys/photo_pose.h"
#include "client/cli/options/placing_options.h"
#include "model/body/doll.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/fit/solver/inverse_kinematics.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/joint_angles.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/mirror.h"

namespace choreo::cli {
namespace {

constexpr double kOutOfReach = 0.01;  // metres

/// "left_elbow=90": a joint and its numbers.
struct Assignment {
  std::string field;  ///< the option as it was given
  int joint = -1;
  std::vector<double> numbers = {};
};

Assignment Parse(const std::string& option, const std::string& text, const Skeleton& skeleton) {
  Assignment parsed{.field = option + " " + text};
  const size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw InvalidArgument(parsed.field, "has no =, as in left_elbow=90");
  parsed.joint = RequireJoint(skeleton, text.substr(0, equals), parsed.field);
  parsed.numbers = ParseNumbers(std::string_view(text).substr(equals + 1), parsed.field);
  return parsed;
}

authoring::NamedPose Begin(const PoseRecipe& recipe, const Skeleton& skeleton) {
  if (recipe.from_landmarks.empty() && recipe.from_smpl.empty() && recipe.from != "rest")
    return authoring::ReadPose(recipe.from, skeleton);
  client::KeyPose key;
  key.id = "photo";
  if (!recipe.from_landmarks.empty()) {
    key.pose = authoring::ReadLandmarkPose(recipe.from_landmarks, skeleton);
  } else if (!recipe.from_smpl.empty()) {
    key.pose = authoring::ReadSmplPose(recipe.from_smpl, skeleton);
  } else {
    key.id = recipe.from;
    key.pose = RestPose(skeleton);
  }
  return {std::move(key)};
}

void Set(const std::vector<std::string>& set, const Skeleton& skeleton, client::KeyPose* key) {
  for (const std::string& text : set) {
    const auto [field, joint, degrees] = Parse("--set", text, skeleton);
    key->pose.rotations.col(joint) = RotationFromDegrees(skeleton, joint, degrees, field);
    if (!key->mask.joints.empty()) key->mask.joints[static_cast<size_t>(joint)] = true;
  }
}

void Draw(const PoseRecipe& recipe, const Skeleton& skeleton, Pose* pose) {
  std::vector<JointTarget> targets;
  std::vector<std::string> fields;
  for (const std::string& text : recipe.reach) {
    auto [field, joint, place] = Parse("--reach", text, skeleton);
    if (place.size() != 3)
      throw InvalidArgument(field, "takes three numbers, metres along x, y and z; there are " +
                                       std::to_string(place.size()));
    if (std::ranges::find(targets, joint, &JointTarget::joint) != targets.end())
      throw InvalidArgument(field, "this joint has a target already");
    if (std::ranges::find(skeleton.feet, joint) != skeleton.feet.end())
      place[1] += FloorClearance(skeleton)[joint];
    targets.push_back({joint, {place[0], place[1], place[2]}});
    fields.push_back(std::move(field));
  }
  DrawnPose drawn = DrawJoints(skeleton, *pose, targets,
                               recipe.keeps_hands ? UpperBody::kStays : UpperBody::kFollowsPelvis);
  for (size_t i = 0; i < targets.size(); ++i) {
    if (drawn.missed_m[i] <= kOutOfReach) continue;
    throw InvalidArgument(
        fields[i],
        "is out of reach: " + skeleton.joint_names[static_cast<size_t>(targets[i].joint)] +
            " ended " + Rounded(100 * drawn.missed_m[i]) + " cm off, and may be " +
            Rounded(100 * kOutOfReach) + " cm");
  }
  *pose = std::move(drawn.pose);
}

void MirrorKey(const Skeleton& skeleton, client::KeyPose* key) {
  const std::vector<int> pairs = MirrorPairs(skeleton);
  key->pose = Mirror(pairs, key->pose);
  const std::vector<bool> joints = key->mask.joints;
  for (size_t joint = 0; joint < joints.size(); ++joint)
    key->mask.joints[joint] = joints[static_cast<size_t>(pairs[joint])];
}

}  // namespace

authoring::NamedPose MakePose(const PoseRecipe& recipe, const Skeleton& skeleton) {
  authoring::NamedPose begun = Begin(recipe, skeleton);
  client::KeyPose& key = begun.key;
  Set(recipe.set, skeleton, &key);
  if (recipe.height_m)
    key.pose.root_position.y() += *recipe.height_m - DollAboveFloor(skeleton, key.pose);
  Draw(recipe, skeleton, &key.pose);
  if (recipe.mirror) MirrorKey(skeleton, &key);
  if (begun.has_place)
    authoring::PlaceRoot(recipe.placing, "--place", &key);
  else
    key.pose = recipe.placing.From(GroundFrame()).ToWorld(key.pose);
  return begun;
}

}  // namespace choreo::cli
