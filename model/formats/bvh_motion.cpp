#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <map>

#include "model/core/error.h"
#include "model/formats/bvh.h"
#include "model/formats/own_arrays.h"
#include "model/formats/own_skeleton.h"
#include "model/motion/resample.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kSameOffset = 0.001;  // metres
constexpr double kMetresBelow = 5;     // a body of less units than these is in metres

constexpr BvhChannel kRotations[] = {BvhChannel::kZRotation, BvhChannel::kXRotation,
                                     BvhChannel::kYRotation};

/// Where a joint stands in its parent, file units, and how it is turned there.
struct BvhPlacement {
  Eigen::Vector3d position;
  Eigen::Matrix3d rotation;
};

/// Of the joint's channels, `values` are those of one frame.
BvhPlacement PlaceBvhJoint(const BvhJoint& joint, const double* values) {
  BvhPlacement local{joint.offset, Eigen::Matrix3d::Identity()};
  for (const BvhChannel channel : joint.channels) {
    const double value = *values++;
    const int axis = static_cast<int>(channel) % 3;
    if (channel <= BvhChannel::kZPosition) {
      local.position[axis] = value;
    } else {
      local.rotation *= Eigen::AngleAxisd(value * M_PI / 180, Eigen::Vector3d::Unit(axis)).matrix();
    }
  }
  return local;
}

// Angles z, x, y (radians) with R = Rz Rx Ry, of the two solutions (and their whole turns) the one
// nearest to `previous`.
Eigen::Vector3d EulerZxy(const Eigen::Matrix3d& r, const Eigen::Vector3d& previous) {
  // Where x is a quarter turn, z and y are one angle: y stays what it was.
  const bool locked = std::hypot(r(2, 0), r(2, 2)) < 1e-9;
  const double y = locked ? previous.z() : std::atan2(-r(2, 0), r(2, 2));
  const Eigen::Matrix3d zx = r * Eigen::AngleAxisd(-y, Eigen::Vector3d::UnitY()).matrix();
  const Eigen::Vector3d one(std::atan2(zx(1, 0), zx(0, 0)), std::atan2(zx(2, 1), zx(2, 2)), y);
  const Eigen::Vector3d other(one.x() + M_PI, M_PI - one.y(), one.z() + M_PI);
  const auto near = [&](Eigen::Vector3d angles) {
    for (int i = 0; i < 3; ++i) angles[i] = previous[i] + WrapAngle(angles[i] - previous[i]);
    return angles;
  };
  const Eigen::Vector3d a = near(one), b = near(other);
  return (a - previous).squaredNorm() <= (b - previous).squaredNorm() ? a : b;
}

// Our joints in the order in which the file's blocks stand: [position in the file] → our index, -1
// for an End Site.
std::vector<int> FileOrder(const Skeleton& skeleton) {
  std::vector<int> order;
  const std::function<void(int)> visit = [&](int joint) {
    order.push_back(joint);
    bool leaf = true;
    for (int child = joint + 1; child < skeleton.joints(); ++child) {
      if (skeleton.parents[child] != joint) continue;
      leaf = false;
      visit(child);
    }
    if (leaf) order.push_back(-1);
  };
  visit(0);
  return order;
}

std::vector<BvhJoint> MakeHierarchy(const Skeleton& skeleton, const std::vector<int>& order,
                                    const BvhLayout& layout) {
  std::vector<BvhJoint> joints;
  std::vector<int> in_file(skeleton.joints(), -1);
  for (const int index : order) {
    BvhJoint joint;
    if (index < 0) {  // a leaf's bone goes on for half of its length
      const int leaf = static_cast<int>(joints.size()) - 1;
      joint.name = joints[leaf].name + "_end";
      joint.parent = leaf;
      joint.offset = joints[leaf].offset / 2;
      joint.end_site = true;
    } else {
      in_file[index] = static_cast<int>(joints.size());
      joint.name = JointName(skeleton.joint_names[index], layout.names);
      joint.offset = skeleton.offsets.col(index) * layout.units_per_metre;
      if (index == 0) {
        joint.offset.y() = skeleton.pelvis_height * layout.units_per_metre;
        joint.channels = {BvhChannel::kXPosition, BvhChannel::kYPosition, BvhChannel::kZPosition};
      } else {
        joint.parent = in_file[skeleton.parents[index]];
      }
      joint.channels.insert(joint.channels.end(), std::begin(kRotations), std::end(kRotations));
    }
    joints.push_back(std::move(joint));
  }
  return joints;
}

/// Joints of ours by what they are called in this layout.
std::map<std::string, int> Called(const Skeleton& skeleton, JointNames names) {
  std::map<std::string, int> out;
  for (int joint = 0; joint < skeleton.joints(); ++joint)
    out[JointName(skeleton.joint_names[static_cast<size_t>(joint)], names)] = joint;
  return out;
}

bool IsIn(const BvhFile& file, const Skeleton& skeleton, const BvhLayout& layout) {
  const std::map<std::string, int> called = Called(skeleton, layout.names);
  int found = 0;
  for (const BvhJoint& joint : file.joints) {
    if (joint.end_site) continue;
    const auto ours = called.find(joint.name);
    if (ours == called.end()) return false;
    const int parent = skeleton.parents[ours->second];
    const bool is_root = joint.parent < 0;
    if (is_root) {
      if (parent != -1) return false;
    } else {
      const auto above = called.find(file.joints[joint.parent].name);
      if (parent < 0 || above == called.end() || above->second != parent) return false;
      const Eigen::Vector3d offset = joint.offset / layout.units_per_metre;
      if ((offset - skeleton.offsets.col(ours->second)).norm() > kSameOffset) return false;
    }
    ++found;
  }
  return found == skeleton.joints();
}

/// How a file has this skeleton, if it has.
std::optional<BvhLayout> LayoutOf(const BvhFile& file, const Skeleton& skeleton) {
  for (const JointNames names : kAllJointNames) {
    for (const double units : {kCentimetres, kMetres}) {
      const BvhLayout layout{names, units};
      if (IsIn(file, skeleton, layout)) return layout;
    }
  }
  return std::nullopt;
}

}  // namespace

double BvhFile::fps() const { return WholeRate(1 / frame_time); }

std::vector<std::string> BvhFile::JointNames() const {
  std::vector<std::string> names;
  for (const BvhJoint& joint : joints) names.push_back(joint.name);
  return names;
}

Eigen::Matrix3Xd BvhPositions(const BvhFile& file, int64_t frame) {
  Eigen::Matrix3Xd positions(3, file.joints.size());
  std::vector<Eigen::Matrix3d> rotations(file.joints.size());
  const double* values = file.values.col(frame).data();
  for (size_t i = 0; i < file.joints.size(); ++i) {
    const BvhJoint& joint = file.joints[i];
    const BvhPlacement local = PlaceBvhJoint(joint, values);
    values += joint.channels.size();
    if (joint.parent < 0) {
      positions.col(i) = local.position;
      rotations[i] = local.rotation;
    } else {
      positions.col(i) = positions.col(joint.parent) + rotations[joint.parent] * local.position;
      rotations[i] = rotations[joint.parent] * local.rotation;
    }
  }
  return positions;
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
  const std::vector<int> order = FileOrder(skeleton);
  BvhFile file;
  file.joints = MakeHierarchy(skeleton, order, layout);
  file.frame_time = 1 / motion.fps;
  file.values.resize(3 + 3 * skeleton.joints(), static_cast<int64_t>(motion.frames.size()));
  Eigen::Matrix3Xd euler = Eigen::Matrix3Xd::Zero(3, skeleton.joints());  // of the frame before
  for (size_t frame = 0; frame < motion.frames.size(); ++frame) {
    const Pose& pose = motion.frames[frame];
    auto values = file.values.col(static_cast<int64_t>(frame));
    values.head<3>() = pose.root_position * layout.units_per_metre;
    int row = 3;
    for (const int joint : order) {
      if (joint < 0) continue;
      euler.col(joint) = EulerZxy(ExpMap(pose.rotations.col(joint)), euler.col(joint));
      values.segment<3>(row) = euler.col(joint) / (M_PI / 180);
      row += 3;
    }
  }
  return file;
}

std::optional<Skeleton> BvhSkeleton(const BvhFile& file) {
  std::vector<std::string> names;
  std::vector<int> parents, index;  // index: of every joint of the file, -1 for an End Site
  Eigen::Matrix3Xd places(3, std::ssize(file.joints));
  for (const BvhJoint& joint : file.joints) {
    index.push_back(joint.end_site ? -1 : static_cast<int>(names.size()));
    if (joint.end_site) continue;
    const int parent = joint.parent < 0 ? -1 : index[static_cast<size_t>(joint.parent)];
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    if (parent >= 0) place = places.col(parent) + joint.offset;
    places.col(std::ssize(names)) = place;
    names.push_back(joint.name);
    parents.push_back(parent);
  }
  const Eigen::Matrix3Xd body = places.leftCols(std::ssize(names));
  const double unit = body.cwiseAbs().maxCoeff() < kMetresBelow ? kMetres : kCentimetres;
  auto skeleton = OwnSkeleton(names, parents, body / unit);
  // A joint above the root would move it.
  return skeleton && skeleton->joint_names == names ? skeleton : std::nullopt;
}

bool IsBvhOf(const BvhFile& file, const Skeleton& skeleton) {
  return LayoutOf(file, skeleton).has_value();
}

Motion BvhToMotion(const BvhFile& file, const Skeleton& skeleton) {
  const std::optional<BvhLayout> layout = LayoutOf(file, skeleton);
  if (!layout) {
    throw InvalidArgument("hierarchy", "is not the " + std::to_string(skeleton.joints()) +
                                           " joints of " + skeleton.name +
                                           " with their rest offsets in centimetres or metres");
  }
  const std::map<std::string, int> called = Called(skeleton, layout->names);
  Motion motion;
  motion.fps = file.fps();
  for (int64_t frame = 0; frame < file.frames(); ++frame) {
    const double* values = file.values.col(frame).data();
    Pose pose;
    pose.rotations.resize(3, skeleton.joints());
    for (const BvhJoint& joint : file.joints) {
      const BvhPlacement local = PlaceBvhJoint(joint, values);
      values += joint.channels.size();
      if (joint.end_site) continue;
      if (joint.parent < 0) pose.root_position = local.position / layout->units_per_metre;
      pose.rotations.col(called.at(joint.name)) = LogMap(local.rotation);
    }
    motion.frames.push_back(std::move(pose));
  }
  MakeContinuous(motion);
  return motion;
}

}  // namespace choreo
