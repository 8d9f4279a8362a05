#include "model/formats/own_skeleton.h"

#include <algorithm>

#include "model/core/error.h"

namespace choreo {
namespace {

int Find(const std::vector<std::string>& names, const char* name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

bool IsBelow(int node, int ancestor, const std::vector<int>& parents) {
  while (node >= 0 && node != ancestor) node = parents[static_cast<size_t>(node)];
  return node == ancestor;
}

// Where hips and shoulders come together, or -1.
int FindRoot(const std::vector<std::string>& names, const std::vector<int>& parents) {
  const int limbs[] = {Find(names, "left_hip"), Find(names, "right_hip"),
                       Find(names, "left_shoulder"), Find(names, "right_shoulder")};
  const auto carries_all = [&](int node) {
    return std::all_of(std::begin(limbs), std::end(limbs), [&](int limb) {
      return limb >= 0 && limb != node && IsBelow(limb, node, parents);
    });
  };
  int node = limbs[0];
  while (node >= 0 && !carries_all(node)) node = parents[static_cast<size_t>(node)];
  return node;
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
    const int above = parents[static_cast<size_t>(node)];
    if (node != root && above > node) return std::nullopt;
    joint_of[static_cast<size_t>(node)] = skeleton.joints();
    skeleton.joint_names.push_back(names[static_cast<size_t>(node)]);
    skeleton.parents.push_back(node == root ? -1 : joint_of[static_cast<size_t>(above)]);
    skeleton.offsets.conservativeResize(3, skeleton.joints());
    skeleton.offsets.rightCols<1>().setZero();
    if (node != root) skeleton.offsets.rightCols<1>() = places.col(node) - places.col(above);
  }
  skeleton.AssignRoles();
  skeleton.StandOnFloor();
  try {
    skeleton.Validate();
    skeleton.RequireRoles();
  } catch (const Error&) {
    return std::nullopt;
  }
  return skeleton;
}

}  // namespace choreo
