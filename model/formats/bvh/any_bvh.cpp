#include "model/formats/bvh/any_bvh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/formats/bvh/bvh.h"
#include "model/formats/reading/motion_check.h"
#include "model/formats/reading/node_motion.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

// The joints that move: those whose values differ between frames or, if none do, those with
// channels.
std::vector<bool> MovedJoints(const BvhFile& file) {
  std::vector<bool> moves, has;
  Eigen::Index row = 0;
  for (const BvhJoint& joint : file.joints) {
    bool differs = false;
    for (size_t i = 0; i < joint.channels.size(); ++i, ++row)
      differs = differs || file.values.row(row).maxCoeff() > file.values.row(row).minCoeff();
    moves.push_back(differs);
    has.push_back(!joint.channels.empty());
  }
  return std::ranges::find(moves, true) == moves.end() ? has : moves;
}

Motion FitBvh(const BvhFile& file, const MotionReading& reading) {
  NodeMotion motion{
      .fps = file.fps(), .rests = {PlaceBvhAtRest(file)}, .count = file.frames(), .frame = {}};
  motion.frame = [&](int64_t frame) { return PlaceBvh(file, frame); };
  RigNodes nodes{.names = file.JointNames(),
                 .parents = {},
                 .places = motion.rests[0].places,
                 .joints = std::vector<bool>(file.joints.size(), true),
                 .moves = MovedJoints(file),
                 .meshes = std::vector<bool>(file.joints.size())};
  for (const BvhJoint& joint : file.joints) nodes.parents.push_back(joint.parent);
  return FitNodes(std::move(nodes), motion, reading);
}

// Converts angles that look like radians to degrees. In radians some angles exceed 1, and none
// exceeds a whole turn unless a root keeps turning slowly.
std::optional<BvhFile> FromRadians(const BvhFile& file, const MotionReading& reading) {
  constexpr Eigen::Index kMinFrames = 10;  // fewer frames prove nothing
  constexpr double kTurn = 2 * M_PI + 1e-3, kLimb = 1;
  if (reading.angles == "degrees" || (reading.angles.empty() && file.frames() < kMinFrames))
    return std::nullopt;
  BvhFile turned = file;
  double farthest = 0, fastest = 0;
  int spinning = 0;
  Eigen::Index row = 0;
  for (const BvhJoint& joint : file.joints) {
    const bool is_root = joint.parent < 0 || joint.channels.size() > 3;
    bool exceeds = false;
    for (const BvhChannel channel : joint.channels) {
      if (channel >= BvhChannel::kXRotation && channel <= BvhChannel::kZRotation) {
        const Eigen::RowVectorXd angles = file.values.row(row);
        const double most = angles.cwiseAbs().maxCoeff();
        if (most < kTurn) {
          farthest = std::max(farthest, most);
        } else {
          exceeds = true;
          for (Eigen::Index frame = 1; frame < angles.size(); ++frame)
            fastest = std::max(fastest, std::abs(angles[frame] - angles[frame - 1]));
        }
        turned.values.row(row) *= kDegrees;
      }
      ++row;
    }
    if (exceeds) spinning += is_root ? 1 : 2;
  }
  const bool may_be = farthest > kLimb && spinning <= 1 && fastest < kLimb;
  return reading.angles == "radians" || may_be ? std::optional(std::move(turned)) : std::nullopt;
}

SkeletonMotion ReadOwnOrFit(const BvhFile& file, const Skeleton* preferred,
                            const MotionReading& reading) {
  const Skeleton& smpl = Skeleton::Smpl24();
  const auto own = BvhSkeleton(file);
  for (const Skeleton* known : {preferred, &smpl, own ? &*own : nullptr}) {
    if (known == nullptr || reading.chooses()) continue;
    if (auto motion = BvhToMotion(file, *known)) return {*known, std::move(*motion)};
  }
  return {smpl, FitBvh(file, reading)};
}

}  // namespace

SkeletonMotion ReadAnyBvh(const std::filesystem::path& path, const Skeleton* preferred,
                          const MotionReading& reading) {
  BvhFile file = ReadBvh(path);
  for (const std::string& note : file.notes) reading.Note(note);
  if (!file.states_rate && reading.fps > 0) file.frame_time = 1 / reading.fps;
  if (!file.states_rate && !(reading.fps > 0) && file.frames() > 1) reading.NoteRate(file.fps());
  if (file.frames() == 0) return {Skeleton::Smpl24(), {}};
  if (const std::optional<BvhFile> turned = FromRadians(file, reading)) {
    if (!reading.angles.empty()) return ReadOwnOrFit(*turned, preferred, reading);
    std::vector<std::string> notes;
    MotionReading quietly = reading;
    quietly.notes = &notes;
    SkeletonMotion read = ReadOwnOrFit(*turned, preferred, quietly);
    // If degrees of a dancer who sways a little were read as radians, knees and elbows would bend
    // backwards.
    if (ShareOfFaults(read.skeleton, read.motion) < 0.1) {
      reading.Note(
          "its angles are read as radians, as they are so small; --angles degrees overrides that");
      for (const std::string& note : notes) reading.Note(note);
      return read;
    }
    reading.Note(
        "its angles are read as degrees, though they are small; --angles radians overrides that");
  }
  return ReadOwnOrFit(file, preferred, reading);
}

}  // namespace choreo
