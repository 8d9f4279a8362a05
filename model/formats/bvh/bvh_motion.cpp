#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/formats/arrays/own_arrays.h"
#include "model/formats/bvh/bvh.h"
#include "model/formats/bvh/euler_angles.h"
#include "model/formats/reading/own_skeleton.h"
#include "model/motion/resample.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kMetresBelow = 5;  // units: a smaller body is in metres

constexpr BvhChannel kRotations[] = {BvhChannel::kZRotation, BvhChannel::kXRotation,
                                     BvhChannel::kYRotation};

/// A joint's position, in file units, and rotation relative to its parent.
struct BvhPlacement {
  Eigen::Vector3d position;
  Eigen::Matrix3d rotation;
};

/// `values`: the joint's channels in one frame.
BvhPlacement PlaceBvhJoint(const BvhJoint& joint, const double* values) {
  BvhPlacement local{joint.offset, Eigen::Matrix3d::Identity()};
  for (const BvhChannel channel : joint.channels) {
    const double value = *values++;
    const int axis = static_cast<int>(channel) % 3;
    if (channel <= BvhChannel::kZPosition) {
      local.position[axis] = joint.adds ? joint.offset[axis] + value : value;
    } else if (channel <= BvhChannel::kZRotation) {
      local.rotation *= Eigen::AngleAxisd(value / kDegrees, Eigen::Vector3d::Unit(axis)).matrix();
    }
  }
  return local;
}

/// The blocks of a file and our joint for each, -1 for an End Site.
struct BvhBlocks {
  std::vector<BvhJoint> joints;
  std::vector<int> ours;
};

/// Appends one of our joints and its descendants below the block `parent`.
void AppendBlocks(const Skeleton& skeleton, const BvhLayout& layout, int index, int parent,
                  BvhBlocks& blocks) {
  const auto block = static_cast<int>(blocks.joints.size());
  BvhJoint joint{.name = JointName(skeleton.joint_names[index], layout.names),
                 .parent = parent,
                 .offset = skeleton.offsets.col(index) * layout.units_per_metre,
                 .channels = {std::begin(kRotations), std::end(kRotations)}};
  if (index == 0) {
    joint.offset.y() = skeleton.pelvis_height * layout.units_per_metre;
    joint.channels.insert(joint.channels.begin(),
                          {BvhChannel::kXPosition, BvhChannel::kYPosition, BvhChannel::kZPosition});
  }
  blocks.joints.push_back(joint);
  blocks.ours.push_back(index);
  for (int child = index + 1; child < skeleton.joints(); ++child) {
    if (skeleton.parents[child] == index) AppendBlocks(skeleton, layout, child, block, blocks);
  }
  if (blocks.ours.back() != index) return;
  // A leaf's End Site is half of its bone's length further.
  blocks.joints.push_back({.name = joint.name + "_end",
                           .parent = block,
                           .offset = joint.offset / 2,
                           .channels = {},
                           .end_site = true});
  blocks.ours.push_back(-1);
}

/// Maps each joint of a file to ours in this layout, -1 for an End Site. None if the file has
/// another skeleton.
std::optional<std::vector<int>> FindJoints(const BvhFile& file, const Skeleton& skeleton,
                                           const BvhLayout& layout) {
  std::vector<std::string> names;
  for (const std::string& joint : skeleton.joint_names)
    names.push_back(JointName(joint, layout.names));
  std::vector<int> found;
  for (const BvhJoint& joint : file.joints) {
    const int index = joint.end_site ? -1 : IndexOf(names, joint.name);
    found.push_back(index);
    if (joint.end_site) continue;
    const int parent = joint.parent < 0 ? -1 : found[joint.parent];
    if (index < 0 || skeleton.parents[index] != parent) return std::nullopt;
    const Eigen::Vector3d offset = joint.offset / layout.units_per_metre;
    if (parent >= 0 && (offset - skeleton.offsets.col(index)).norm() > kSameBone)
      return std::nullopt;
  }
  if (std::ssize(found) - std::ranges::count(found, -1) != skeleton.joints()) return std::nullopt;
  return found;
}

/// The motion of the joints that FindJoints found.
Motion TakeJoints(const BvhFile& file, const std::vector<int>& found, int joints,
                  double units_per_metre) {
  Motion motion;
  motion.fps = file.fps();
  for (int64_t frame = 0; frame < file.frames(); ++frame) {
    const double* values = file.values.col(frame).data();
    Pose& pose = motion.frames.emplace_back();
    pose.rotations.setZero(3, joints);
    for (size_t i = 0; i < file.joints.size(); ++i) {
      const BvhJoint& joint = file.joints[i];
      const BvhPlacement local = PlaceBvhJoint(joint, values);
      values += joint.channels.size();
      if (joint.end_site) continue;
      if (joint.parent < 0) pose.root_position = local.position / units_per_metre;
      pose.rotations.col(found[i]) = LogMap(local.rotation);
    }
  }
  MakeContinuous(motion);
  return motion;
}

}  // namespace

double BvhFile::fps() const { return WholeRate(1 / frame_time); }

std::vector<std::string> BvhFile::JointNames() const {
  std::vector<std::string> names;
  for (const BvhJoint& joint : joints) names.push_back(joint.name);
  return names;
}

RigPlacement PlaceBvh(const BvhFile& file, int64_t frame) {
  RigPlacement all{Eigen::Matrix3Xd(3, file.joints.size()),
                   std::vector<Eigen::Matrix3d>(file.joints.size())};
  const double* values = file.values.col(frame).data();
  for (size_t i = 0; i < file.joints.size(); ++i) {
    const BvhJoint& joint = file.joints[i];
    const BvhPlacement local = PlaceBvhJoint(joint, values);
    values += joint.channels.size();
    if (joint.parent < 0) {
      all.places.col(i) = local.position;
      all.turns[i] = local.rotation;
    } else {
      all.places.col(i) = all.places.col(joint.parent) + all.turns[joint.parent] * local.position;
      all.turns[i] = all.turns[joint.parent] * local.rotation;
    }
  }
  return all;
}

RigPlacement PlaceBvhAtRest(const BvhFile& file) {
  RigPlacement all{Eigen::Matrix3Xd(3, file.joints.size()),
                   std::vector<Eigen::Matrix3d>(file.joints.size(), Eigen::Matrix3d::Identity())};
  for (size_t i = 0; i < file.joints.size(); ++i) {
    const BvhJoint& joint = file.joints[i];
    all.places.col(i) = joint.offset;
    if (joint.parent >= 0) all.places.col(i) += all.places.col(joint.parent);
  }
  return all;
}

Eigen::Matrix3Xd BvhPositions(const BvhFile& file, int64_t frame) {
  return PlaceBvh(file, frame).places;
}

PositionClip BvhToPositions(const BvhFile& file, double metres_per_unit) {
  PositionClip clip;
  clip.fps = file.fps();
  clip.joint_names = file.JointNames();
  for (int64_t frame = 0; frame < file.frames(); ++frame) {
    clip.frames.push_back(BvhPositions(file, frame) * metres_per_unit);
  }
  return clip;
}

BvhFile MotionToBvh(const Skeleton& skeleton, const Motion& motion, const BvhLayout& layout) {
  RequireWritable(skeleton, motion);
  if (layout.names != JointNames::kSmpl && skeleton.joint_names != Skeleton::Smpl24().joint_names) {
    throw InvalidArgument("names", std::string(NameOf(layout.names)) +
                                       " has names for SMPL's joints alone, the skeleton is " +
                                       skeleton.Describe());
  }
  BvhBlocks blocks;
  AppendBlocks(skeleton, layout, 0, -1, blocks);
  BvhFile file;
  file.joints = std::move(blocks.joints);
  file.frame_time = 1 / motion.fps;
  file.values.resize(3 + 3 * skeleton.joints(), static_cast<int64_t>(motion.frames.size()));
  for (size_t frame = 0; frame < motion.frames.size(); ++frame) {
    file.values.col(static_cast<int64_t>(frame)).head<3>() =
        motion.frames[frame].root_position * layout.units_per_metre;
  }
  int row = 3;
  for (const int joint : blocks.ours) {
    if (joint < 0) continue;
    std::vector<Eigen::Matrix3d> rotations;
    for (const Pose& pose : motion.frames) rotations.push_back(ExpMap(pose.rotations.col(joint)));
    file.values.middleRows<3>(row) = EulerAnglesZxy(rotations) * kDegrees;
    row += 3;
  }
  return file;
}

std::optional<Skeleton> BvhSkeleton(const BvhFile& file) {
  std::vector<std::string> names;
  std::vector<int> parents, index;  // index: of every joint of the file, -1 for an End Site
  Eigen::Matrix3Xd places = Eigen::Matrix3Xd::Zero(3, std::ssize(file.joints));
  for (const BvhJoint& joint : file.joints) {
    index.push_back(joint.end_site ? -1 : static_cast<int>(names.size()));
    if (joint.end_site) continue;
    const int parent = joint.parent < 0 ? -1 : index[static_cast<size_t>(joint.parent)];
    if (parent >= 0) places.col(std::ssize(names)) = places.col(parent) + joint.offset;
    names.push_back(joint.name);
    parents.push_back(parent);
  }
  const Eigen::Matrix3Xd body = places.leftCols(std::ssize(names));
  const double unit = body.cwiseAbs().maxCoeff() < kMetresBelow ? kMetres : kCentimetres;
  auto skeleton = OwnSkeleton(names, parents, body / unit);
  // A joint above the root would move it.
  return skeleton && skeleton->joint_names == names ? skeleton : std::nullopt;
}

std::optional<Motion> BvhToMotion(const BvhFile& file, const Skeleton& skeleton) {
  for (const JointNames names : kAllJointNames) {
    for (const double units : {kCentimetres, kMetres}) {
      if (const auto joints = FindJoints(file, skeleton, {names, units}))
        return TakeJoints(file, *joints, skeleton.joints(), units);
    }
  }
  return std::nullopt;
}

}  // namespace choreo
