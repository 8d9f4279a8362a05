#include "model/formats/joint_arrays.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/formats/node_motion.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

constexpr const char* kPlacesNames[] = {"joints", "joints3d", "joint_positions", "positions"};
constexpr int64_t kPlacedBody = 22;
// Of a limb's mean length: networks stretch bones a little.
constexpr double kStretch = 0.1;

const Skeleton& PlacedBody() { return Skeleton::Smpl24(); }

/// Joints of all frames, [3, joints] each; none where the shape is another.
std::vector<Eigen::Matrix3Xd> PlacesOfFrames(const NpyArray& array) {
  std::vector<int64_t> shape = array.shape;
  if (shape.size() == 4 && shape[0] == 1) shape.erase(shape.begin());
  std::vector<Eigen::Matrix3Xd> frames;
  if (shape.size() != 3 || shape[2] != 3 ||
      (shape[1] != kPlacedBody && shape[1] != PlacedBody().joints()))
    return frames;
  const std::vector<double> values = array.As<double>();
  for (int64_t frame = 0; frame < shape[0]; ++frame)
    frames.emplace_back(
        Eigen::Map<const Eigen::Matrix3Xd>(values.data() + 3 * shape[1] * frame, 3, shape[1]));
  return frames;
}

bool KeepLengths(const std::vector<Eigen::Matrix3Xd>& frames) {
  const Skeleton& body = PlacedBody();
  for (const int joint : {body.left_knee, body.right_knee, body.feet[0], body.feet[2],
                          body.left_elbow, body.right_elbow}) {
    double sum = 0, squares = 0;
    for (const Eigen::Matrix3Xd& places : frames) {
      const double length = (places.col(joint) - places.col(body.parents[joint])).norm();
      sum += length;
      squares += length * length;
    }
    const double mean = sum / static_cast<double>(frames.size());
    const double variance = squares / static_cast<double>(frames.size()) - mean * mean;
    if (!(mean > 0) || !(variance < kStretch * kStretch * mean * mean)) return false;
  }
  return true;
}

}  // namespace

std::optional<NpyArray> FindJointArray(const NpzArchive& npz) {
  for (const char* name : kPlacesNames) {
    if (npz.Has(name)) return npz.Array(name);
  }
  return std::nullopt;
}

bool AreJointPlaces(const NpyArray& array) {
  const std::vector<Eigen::Matrix3Xd> frames = PlacesOfFrames(array);
  // Those of a single frame keep theirs, whatever they are.
  return frames.size() > 1 && KeepLengths(frames);
}

Motion ReadJointPlaces(const NpyArray& array, double fps, const MotionReading& reading) {
  const std::vector<Eigen::Matrix3Xd> frames = PlacesOfFrames(array);
  if (frames.empty() || !AreJointPlaces(array)) {
    throw InvalidArgument("joints",
                          "are no places [frames, 22 or 24, 3] of SMPL's joints, whose "
                          "limbs keep their lengths, in several frames");
  }
  const auto count = static_cast<size_t>(frames[0].cols());
  const auto first = [count](const auto& all) {
    return std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  };
  RigNodes nodes{.names = first(PlacedBody().joint_names),
                 .parents = first(PlacedBody().parents),
                 .places = frames[0],
                 .joints = std::vector<bool>(count, true),
                 .moves = std::vector<bool>(count, true),
                 .meshes = std::vector<bool>(count)};
  NodeMotion motion{.fps = fps, .count = static_cast<int64_t>(frames.size()), .has_turns = false};
  motion.frame = [&](int64_t frame) {
    return RigPlacement{frames[static_cast<size_t>(frame)],
                        std::vector<Eigen::Matrix3d>(count, Eigen::Matrix3d::Identity())};
  };
  return FitNodes(std::move(nodes), motion, reading);
}

}  // namespace choreo
