#include "model/motion/skeleton.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string_view>
#include <utility>

#include "model/core/error.h"

namespace choreo {
namespace {

struct RestJoint {
  const char* name;
  int parent;
  double x, y, z;
};

// SMPL's original names; offsets of the neutral body.
constexpr RestJoint kSmplJoints[] = {
    {"pelvis", -1, 0, 0, 0},
    {"left_hip", 0, 0.05858135, -0.08228004, -0.01766408},
    {"right_hip", 0, -0.06030973, -0.09051332, -0.01354254},
    {"spine1", 0, 0.00443945, 0.12440352, -0.03838522},
    {"left_knee", 1, 0.04345142, -0.38646945, 0.00803700},
    {"right_knee", 2, -0.04325663, -0.38368791, -0.00484304},
    {"spine2", 3, 0.00448844, 0.13795640, 0.02682033},
    {"left_ankle", 4, -0.01479032, -0.42687458, -0.03742800},
    {"right_ankle", 5, 0.01905555, -0.42004550, -0.03456167},
    {"spine3", 6, -0.00226458, 0.05603239, 0.00285505},
    {"left_foot", 7, 0.04105436, -0.06028581, 0.12204243},
    {"right_foot", 8, -0.03483987, -0.06210566, 0.13032329},
    {"neck", 9, -0.01339020, 0.21163553, -0.03346758},
    {"left_collar", 9, 0.07170245, 0.11399969, -0.01889817},
    {"right_collar", 9, -0.08295366, 0.11247234, -0.02370739},
    {"head", 12, 0.01011321, 0.08893734, 0.05040987},
    {"left_shoulder", 13, 0.12292141, 0.04520509, -0.01904600},
    {"right_shoulder", 14, -0.11322832, 0.04685326, -0.00847207},
    {"left_elbow", 16, 0.25533190, -0.01564902, -0.02294649},
    {"right_elbow", 17, -0.26012748, -0.01436928, -0.03126873},
    {"left_wrist", 18, 0.26570925, 0.01269811, -0.00737473},
    {"right_wrist", 19, -0.26910836, 0.00679372, -0.00602676},
    {"left_hand", 20, 0.08669055, -0.01063603, -0.01559429},
    {"right_hand", 21, -0.08875370, -0.00865157, -0.01010708},
};

Skeleton MakeSmpl24() {
  Skeleton skeleton;
  skeleton.name = "smpl24";
  for (const RestJoint& joint : kSmplJoints)
    skeleton.AddJoint(joint.name, joint.parent, {joint.x, joint.y, joint.z});
  skeleton.AssignRoles();
  skeleton.StandOnFloor();
  skeleton.Check();
  return skeleton;
}

int FindAny(const Skeleton& skeleton, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const int joint = skeleton.Find(name); joint >= 0) return joint;
  }
  return -1;
}

// Works for const and non-const skeletons.
auto Roles(auto& s) {
  return std::array{
      std::pair{"left_hip", &s.left_hip},           std::pair{"right_hip", &s.right_hip},
      std::pair{"left_knee", &s.left_knee},         std::pair{"right_knee", &s.right_knee},
      std::pair{"left_shoulder", &s.left_shoulder}, std::pair{"right_shoulder", &s.right_shoulder},
      std::pair{"left_elbow", &s.left_elbow},       std::pair{"right_elbow", &s.right_elbow},
      std::pair{"left_ankle", &s.feet[0]},          std::pair{"left_toes", &s.feet[1]},
      std::pair{"right_ankle", &s.feet[2]},         std::pair{"right_toes", &s.feet[3]}};
}

}  // namespace

int IndexOf(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

bool IsBelow(int node, int ancestor, const std::vector<int>& parents) {
  while (node >= 0 && node != ancestor) node = parents[static_cast<size_t>(node)];
  return node == ancestor;
}

int Skeleton::Find(std::string_view joint_name) const { return IndexOf(joint_names, joint_name); }

int Skeleton::AddJoint(const std::string& joint_name, int parent, const Eigen::Vector3d& offset) {
  joint_names.push_back(joint_name);
  parents.push_back(parent);
  offsets.conservativeResize(3, joints());
  offsets.rightCols<1>() = offset;
  return joints() - 1;
}

void Skeleton::AssignRoles() {
  for (const auto& [role, joint] : Roles(*this)) *joint = Find(role);
  feet[1] = FindAny(*this, {"left_foot", "left_toes", "left_toe"});
  feet[3] = FindAny(*this, {"right_foot", "right_toes", "right_toe"});
}

std::string Skeleton::Describe() const {
  return "'" + name + "' of " + std::to_string(joints()) + " joints";
}

void Skeleton::StandOnFloor(double clearance) {
  std::vector<double> heights(parents.size(), 0.0);
  double lowest = 0;
  for (int joint = 1; joint < joints(); ++joint) {
    heights[joint] = heights[parents[joint]] + offsets(1, joint);
    lowest = std::min(lowest, heights[joint]);
  }
  pelvis_height = clearance - lowest;
}

void Skeleton::Check() const {
  if (parents.empty()) throw InvalidArgument("skeleton.parents", "0 joints, at least 1 is needed");
  if (joint_names.size() != parents.size()) {
    throw InvalidArgument(
        "skeleton.joint_names",
        std::to_string(joint_names.size()) + " names for " + std::to_string(joints()) + " joints");
  }
  if (offsets.cols() != joints()) {
    throw InvalidArgument("skeleton.offsets", std::to_string(offsets.cols()) + " offsets for " +
                                                  std::to_string(joints()) + " joints");
  }
  std::set<std::string> seen;
  for (int joint = 0; joint < joints(); ++joint) {
    const std::string index = "[" + std::to_string(joint) + "]";
    if (joint_names[joint].empty() || !seen.insert(joint_names[joint]).second) {
      throw InvalidArgument("skeleton.joint_names" + index,
                            "'" + joint_names[joint] + "' is empty or names a second joint");
    }
    const bool is_root = joint == 0;
    if (is_root ? parents[joint] != -1 : parents[joint] < 0 || parents[joint] >= joint) {
      throw InvalidArgument("skeleton.parents" + index,
                            std::to_string(parents[joint]) +
                                (is_root ? ", the root's must be -1"
                                         : ", must be at least 0 and below the joint's own index"));
    }
    if (!offsets.col(joint).allFinite()) {
      throw InvalidArgument("skeleton.offsets" + index, "not finite");
    }
  }
  if (!offsets.col(0).isZero()) throw InvalidArgument("skeleton.offsets[0]", "must be zero");
  if (!(pelvis_height >= 0) || !std::isfinite(pelvis_height)) {
    throw InvalidArgument("skeleton.pelvis_height",
                          std::to_string(pelvis_height) + " m, must be finite and at least 0");
  }
  std::set<int> playing;
  for (const auto& [role, joint] : Roles(*this)) {
    if (*joint < -1 || *joint >= joints()) {
      throw InvalidArgument("skeleton." + std::string(role),
                            std::to_string(*joint) + ", must be -1 or the index of one of " +
                                std::to_string(joints()) + " joints");
    }
    if (*joint >= 0 && !playing.insert(*joint).second) {
      throw InvalidArgument("skeleton." + std::string(role),
                            "'" + joint_names[*joint] + "' plays another role already");
    }
  }
}

void Skeleton::RequireRoles() const {
  for (const auto& [role, joint] : Roles(*this)) {
    if (*joint < 0) throw InvalidArgument("skeleton", Describe() + ": none of them is the " + role);
  }
}

bool SameBones(const Skeleton& a, const Skeleton& b) {
  return a.joint_names == b.joint_names && a.parents == b.parents &&
         (a.offsets - b.offsets).colwise().norm().maxCoeff() <= kSameBone;
}

std::vector<Hinge> Hinges(const Skeleton& skeleton) {
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitZ();
  std::vector<Hinge> hinges;
  const auto add = [&](int joint, int upper, const Eigen::Vector3d& bend_towards) {
    if (joint < 0) return;
    const Eigen::Vector3d axis = skeleton.offsets.col(joint).cross(bend_towards);
    if (axis.norm() > 1e-6) hinges.push_back({joint, upper, axis.normalized()});
  };
  add(skeleton.left_knee, skeleton.left_hip, -forward);
  add(skeleton.right_knee, skeleton.right_hip, -forward);
  add(skeleton.left_elbow, skeleton.left_shoulder, forward);
  add(skeleton.right_elbow, skeleton.right_shoulder, forward);
  return hinges;
}

const Skeleton& Skeleton::Smpl24() {
  static const Skeleton skeleton = MakeSmpl24();
  return skeleton;
}

}  // namespace choreo
