#include "model/formats/reading/node_motion.h"

#include <algorithm>
#include <set>
#include <utility>

#include "model/core/error.h"
#include "model/core/numbers/quantile.h"
#include "model/core/rounded.h"
#include "model/fit/bones/character_body.h"
#include "model/fit/bones/guess_bones.h"
#include "model/formats/reading/motion_check.h"
#include "model/motion/pose/pose_limits.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

// Keeps only the bones' columns.
RigPlacement Keep(const RigPlacement& all, const std::vector<int>& nodes) {
  RigPlacement kept;
  kept.places.resize(3, std::ssize(nodes));
  for (size_t i = 0; i < nodes.size(); ++i) {
    kept.places.col(static_cast<Eigen::Index>(i)) = all.places.col(nodes[i]);
    kept.turns.push_back(all.turns[nodes[i]]);
  }
  return kept;
}

// The node whose rotation is the pelvis's. In MMD it is the node above both legs, if a node above
// that carries the trunk, too.
int TurningPelvis(const HumanBones& found, const std::vector<int>& parents) {
  const int pelvis = found.Find("pelvis"), left = found.Find("left_hip");
  int node = parents[static_cast<size_t>(left)];
  while (node >= 0 && !IsBelow(found.Find("right_hip"), node, parents))
    node = parents[static_cast<size_t>(node)];
  const bool taken =
      std::ranges::any_of(found.bones, [&](const auto& bone) { return bone.second == node; });
  return node >= 0 && !taken && IsBelow(node, pelvis, parents) ? node : pelvis;
}

std::string Listed(const std::vector<std::string>& words) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
  return text;
}

void NoteFit(const RigFit& fit, const MotionReading& reading) {
  if (!fit.exchanged.empty()) {
    reading.Note((fit.exchanged == "body" ? "its" : "its " + fit.exchanged + "'") +
                 " left and right are exchanged, as in a mirror: limbs are assigned by "
                 "position, not by name");
  }
  if (!fit.turns) {
    reading.Note(
        "its joints move without its rotations: only the joints' positions are read, and the "
        "rotations of head, hands and feet are guesses");
  } else if (!fit.rest) {
    reading.Note(
        "its rest pose is not a standing body: the rotations of head, hands and feet at rest are "
        "guesses");
  }
  if (!fit.missing.empty())
    reading.Note("has no " + Listed(fit.missing) + ": our own move with the parts above them");
}

// Notes a mix of units: some files have bones in centimetres and the root's positions in metres.
void NoteUnits(const RigMotion& rig, const RigFit& fit, const MotionReading& reading) {
  constexpr double kMinHeight = 0.5,
                   kMaxHeight = 2;  // height of the pelvis, in leg lengths
  const Eigen::Vector3d up = fit.up.value_or(Eigen::Vector3d::UnitY());
  const auto place = [&](const RigPlacement& at, const char* bone) -> Eigen::Vector3d {
    return at.places.col(rig.bones.Find(bone));
  };
  std::vector<double> heights;
  for (int64_t frame = 0; frame < rig.count; frame += 1 + rig.count / 100)
    heights.push_back(up.dot(place(rig.frame(frame), "pelvis")));
  const RigPlacement first = rig.frame(0);
  const double leg = (place(first, "left_hip") - place(first, "left_knee")).norm() +
                     (place(first, "left_knee") - place(first, "left_ankle")).norm();
  const double height = Median(std::move(heights)) / leg;
  for (const double unit : {100.0, 0.01}) {
    if (height * unit < kMinHeight || height * unit > kMaxHeight) continue;
    reading.Note("its pelvis stands at " + Rounded(height) +
                 " lengths of its legs: are its root's " +
                 "places in another unit than its bones? Then its ways are " + Rounded(1 / unit) +
                 " times as long as they were");
  }
}

}  // namespace

HumanBones FindBody(const RigNodes& nodes, const MotionReading& reading) {
  HumanBones found = FindBones(nodes, reading.bones);
  if (!reading.bones.empty() && !reading.body.empty())
    throw InvalidArgument("--body", "--map already chooses the bones: give only one of both");
  if (!reading.bones.empty() || !MissingBones(found).empty()) return found;
  std::vector<HumanBones> bodies = MovingBodies(nodes, found);
  std::vector<std::string> names;
  for (const HumanBones& body : bodies) {
    const char* bone = body.Find("pelvis") >= 0 ? "pelvis" : "left_hip";
    names.push_back(nodes.names[static_cast<size_t>(body.Find(bone))]);
  }
  if (!reading.body.empty()) return bodies[ChooseBody(reading.body, names)];
  if (bodies.size() > 1) {
    const auto same = [&](const HumanBones& body) { return body.bones == found.bones; };
    const auto read = std::ranges::find_if(bodies, same) - bodies.begin();
    reading.Note("holds " + std::to_string(bodies.size()) + " bodies that move, " +
                 ListBodies(names) + "; " + std::to_string(read) + " is read, --body chooses");
  }
  return found;
}

Motion FitNodes(RigNodes nodes, const NodeMotion& motion, const MotionReading& reading) {
  HumanBones found = FindBody(nodes, reading);
  if (const std::string missing = MissingBones(found); !missing.empty()) {
    // Without a usable rest pose, the first frame is better evidence.
    const bool guessable =
        MissingBones(GuessBones(nodes.parents, nodes.places, nodes.joints)).empty();
    if (!guessable) nodes.places = motion.frame(0).places;
    throw UnknownBones("", missing, std::move(nodes), found);
  }
  found.bones["pelvis"] = TurningPelvis(found, nodes.parents);
  RigMotion rig;
  rig.fps = motion.fps;
  rig.bones.rig = found.rig;
  std::vector<int> kept;
  std::set<std::string> taken;
  for (const auto& [bone, node] : found.bones) {
    rig.bones.bones[bone] = static_cast<int>(kept.size());
    std::string name = nodes.names[static_cast<size_t>(node)];
    while (!taken.insert(name).second) name += "'";
    rig.names.push_back(name);
    kept.push_back(node);
  }
  for (const RigPlacement& rest : motion.rests) rig.rests.push_back(Keep(rest, kept));
  rig.rests_apart = motion.rests_apart;
  rig.count = motion.count;
  rig.frame = [&](int64_t frame) { return Keep(motion.frame(frame), kept); };
  RigFit fit = FitRig(rig, reading.scale);
  CheckMotionLimits(fit.motion);
  NoteFit(fit, reading);
  NoteUnits(rig, fit, reading);
  return CorrectMotion({.skeleton = Skeleton::Smpl24(),
                        .motion = std::move(fit.motion),
                        .rest_up = fit.up,
                        .has_floor = false},
                       reading);
}

}  // namespace choreo
