#include "model/formats/skeleton_npz.h"

#include <utility>

#include "model/core/error.h"
#include "model/motion/skeleton_json.h"

namespace choreo {
namespace {

std::vector<double> Values(const NpzArchive& npz, const std::string& key,
                           const std::vector<int64_t>& shape) {
  const NpyArray array = npz.Array(key);
  if (array.shape != shape) {
    std::string is, must_be;
    for (const int64_t size : array.shape) is += (is.empty() ? "" : ", ") + std::to_string(size);
    for (const int64_t size : shape)
      must_be += (must_be.empty() ? "" : ", ") + std::to_string(size);
    throw InvalidArgument(key, "has the shape [" + is + "], expected [" + must_be + "]");
  }
  std::vector<double> values = array.As<double>();
  if (!Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)).allFinite()) {
    throw InvalidArgument(key, "holds values that are not finite");
  }
  return values;
}

}  // namespace

bool HasSkeletonMotion(const NpzArchive& npz) { return npz.Has("skeleton"); }

SkeletonMotion ReadSkeletonMotion(const NpzArchive& npz) {
  SkeletonMotion read;
  read.skeleton = SkeletonFromJson(npz.Text("skeleton"));
  const int joints = read.skeleton.joints();
  const std::vector<int64_t> shape = npz.Array("rotations").shape;
  const int64_t frames = shape.empty() ? 0 : shape[0];
  const std::vector<double> rotations = Values(npz, "rotations", {frames, joints, 3});
  const std::vector<double> roots = Values(npz, "root_positions", {frames, 3});
  read.motion.fps = Values(npz, "fps", {}).front();
  if (!(read.motion.fps >= 1 && read.motion.fps <= 1000)) {
    throw InvalidArgument("fps",
                          std::to_string(read.motion.fps) + ", must be 1 to 1000 frames a second");
  }
  for (int64_t frame = 0; frame < frames; ++frame) {
    read.motion.frames.push_back(
        {Eigen::Map<const Eigen::Vector3d>(roots.data() + 3 * frame),
         Eigen::Map<const Eigen::Matrix3Xd>(rotations.data() + 3 * joints * frame, 3, joints)});
  }
  return read;
}

void AddSkeletonMotion(const Skeleton& skeleton, const Motion& motion,
                       const std::vector<Contacts>* contacts, NpzArchive& npz) {
  const auto frames = static_cast<int64_t>(motion.frames.size());
  if (frames == 0) throw InvalidArgument("motion.frames", "0 frames, at least 1 is needed");
  std::vector<double> roots, rotations;
  for (const Pose& pose : motion.frames) {
    if (pose.rotations.cols() != skeleton.joints()) {
      throw InvalidArgument("motion.frames", std::to_string(pose.rotations.cols()) +
                                                 " joints, the skeleton is " + skeleton.Describe());
    }
    roots.insert(roots.end(), pose.root_position.data(), pose.root_position.data() + 3);
    rotations.insert(rotations.end(), pose.rotations.data(),
                     pose.rotations.data() + pose.rotations.size());
  }
  npz.SetText("skeleton", SkeletonToJson(skeleton));
  npz.SetArray("root_positions", {{frames, 3}, std::move(roots)});
  npz.SetArray("rotations", {{frames, skeleton.joints(), 3}, std::move(rotations)});
  npz.SetArray("fps", {{}, std::vector<double>{motion.fps}});
  if (contacts == nullptr) return;
  if (contacts->size() != motion.frames.size()) {
    throw InvalidArgument("contacts", std::to_string(contacts->size()) +
                                          " frames, the motion has " + std::to_string(frames));
  }
  std::vector<float> values;
  for (const Contacts& row : *contacts) values.insert(values.end(), row.begin(), row.end());
  npz.SetArray("contacts", {{frames, 4}, std::move(values)});
}

}  // namespace choreo
