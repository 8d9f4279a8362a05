#include "model/formats/reading/own_skeleton.h"

#include <algorithm>

#include "model/core/error.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/limb.h"

namespace choreo {
namespace {

// The joint from which hips and shoulders branch, or -1.
int FindRoot(const std::vector<std::string>& names, const std::vector<int>& parents) {
  const int limbs[] = {IndexOf(names, "left_hip"), IndexOf(names, "right_hip"),
                       IndexOf(names, "left_shoulder"), IndexOf(names, "right_shoulder")};
  const auto carries_all = [&](int node) {
    return std::all_of(std::begin(limbs), std::end(limbs), [&](int limb) {
      return limb >= 0 && limb != node && IsBelow(limb, node, parents);
    });
  };
  int node = limbs[0];
  while (node >= 0 && !carries_all(node)) node = parents[static_cast<size_t>(node)];
  return node;
}

// Whether a skeleton rests like ours: Y up, facing +Z, of a person's size. Rigs of other programs
// with our joint names may not.
bool RestsLikeOurs(const Skeleton& skeleton) {
  constexpr double kUpright = 0.8;                   // cosine
  constexpr double kMinLegs = 0.45, kMaxLegs = 1.4;  // metres
  const Eigen::Matrix3Xd at = JointPositions(skeleton, RestPose(skeleton));
  const Eigen::Vector3d across = at.col(skeleton.left_hip) - at.col(skeleton.right_hip);
  const Eigen::Vector3d trunk = at.col(skeleton.left_shoulder) + at.col(skeleton.right_shoulder) -
                                at.col(skeleton.left_hip) - at.col(skeleton.right_hip);
  double legs = 0;
  for (const Leg& leg : Leg::Of(skeleton)) {
    legs += ((at.col(leg.knee) - at.col(leg.hip)).norm() +
             (at.col(leg.ankle) - at.col(leg.knee)).norm()) /
            2;
  }
  return across.x() > kUpright * across.norm() && trunk.y() > kUpright * trunk.norm() &&
         legs > kMinLegs && legs < kMaxLegs;
}

}  // namespace

std::optional<Skeleton> OwnSkeleton(const std::vector<std::string>& names,
                                    const std::vector<int>& parents,
                                    const Eigen::Matrix3Xd& places) {
  const int root = FindRoot(names, parents);
  if (root < 0 || names[static_cast<size_t>(root)] == Skeleton::Smpl24().joint_names.front())
    return std::nullopt;
  Skeleton skeleton;
  skeleton.name = "own";
  std::vector<int> joint_of(names.size(), -1);
  for (int node = 0; node < static_cast<int>(names.size()); ++node) {
    if (!IsBelow(node, root, parents)) continue;
    int parent = -1;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    if (node != root) {
      const int above = parents[node];
      if (above > node) return std::nullopt;
      parent = joint_of[above];
      offset = places.col(node) - places.col(above);
    }
    joint_of[node] = skeleton.AddJoint(names[node], parent, offset);
  }
  skeleton.AssignRoles();
  skeleton.StandOnFloor();
  try {
    skeleton.Check();
    skeleton.RequireRoles();
  } catch (const Error&) {
    return std::nullopt;
  }
  return RestsLikeOurs(skeleton) ? std::optional(skeleton) : std::nullopt;
}

}  // namespace choreo
