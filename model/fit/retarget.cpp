#include "model/fit/retarget.h"

#include <string>

#include "model/fit/solver/fit_clip.h"
#include "model/fit/sources/mapping_builder.h"
#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

struct Side {
  int hip, knee, ankle, toes, shoulder, elbow;
};
Side LeftOf(const Skeleton& s) {
  return {s.left_hip, s.left_knee, s.feet[0], s.feet[1], s.left_shoulder, s.left_elbow};
}
Side RightOf(const Skeleton& s) {
  return {s.right_hip, s.right_knee, s.feet[2], s.feet[3], s.right_shoulder, s.right_elbow};
}

/// The landmarks that two bodies share.
class CommonMapping {
 public:
  CommonMapping(const Skeleton& from, const Skeleton& to) : from_(from), to_(to) {
    builder_.Add("hips", "", Middle(from, from.left_hip, from.right_hip),
                 MappingBuilder::Between(Name(to, to.left_hip), Name(to, to.right_hip)));
    // Spines differ; only the position of the shoulders counts.
    builder_.Add("shoulders", "hips", Middle(from, from.left_shoulder, from.right_shoulder),
                 MappingBuilder::Between(Name(to, to.left_shoulder), Name(to, to.right_shoulder)),
                 1, false);
    Named("head", "shoulders");
    Limbs("left_", LeftOf(from), LeftOf(to));
    Limbs("right_", RightOf(from), RightOf(to));
  }

  SourceMapping Take() { return builder_.Take(); }

 private:
  static const std::string& Name(const Skeleton& skeleton, int joint) {
    return skeleton.joint_names[joint];
  }
  static JointBlend Middle(const Skeleton& skeleton, int a, int b) {
    return {{Name(skeleton, a), 0.5}, {Name(skeleton, b), 0.5}};
  }
  static Eigen::Vector3d Rest(const Skeleton& skeleton, int joint) {
    return JointPositions(skeleton, RestPose(skeleton)).col(joint);
  }
  void Bone(const std::string& name, const std::string& parent, int from, int to) {
    builder_.Add(name, parent, {{Name(from_, from), 1.0}}, {{.joint = Name(to_, to)}});
  }
  // Returns false if only one of them has such a joint.
  bool Named(const std::string& name, const std::string& parent) {
    const int from = from_.Find(name), to = to_.Find(name);
    if (from < 0 || to < 0) return false;
    Bone(name, parent, from, to);
    return true;
  }
  void Limbs(const std::string& side, const Side& from, const Side& to) {
    Bone(side + "shoulder", "shoulders", from.shoulder, to.shoulder);
    Bone(side + "elbow", side + "shoulder", from.elbow, to.elbow);
    if (Named(side + "wrist", side + "elbow")) Named(side + "hand", side + "wrist");
    Bone(side + "hip", "hips", from.hip, to.hip);
    Bone(side + "knee", side + "hip", from.knee, to.knee);
    Bone(side + "ankle", side + "knee", from.ankle, to.ankle);
    // Ankles differ in height above their soles. This keeps one foot flat where the other is.
    const Eigen::Vector3d sole = (Rest(from_, from.toes) - Rest(from_, from.ankle)).normalized() *
                                 (Rest(to_, to.toes) - Rest(to_, to.ankle)).norm();
    builder_.Add(side + "toes", side + "ankle", {{Name(from_, from.toes), 1.0}},
                 {{.joint = Name(to_, to.ankle), .offset = sole}});
  }

  const Skeleton& from_;
  const Skeleton& to_;
  MappingBuilder builder_{"common", 0.01};
};

}  // namespace

Motion Retarget(const Skeleton& from, const Motion& motion, const Skeleton& to) {
  if (SameBones(from, to)) return motion;
  from.RequireRoles();
  to.RequireRoles();
  PositionClip clip{.fps = motion.fps, .joint_names = from.joint_names, .frames = {}};
  for (const Pose& pose : motion.frames) clip.frames.push_back(JointPositions(from, pose));
  Motion fitted = FitClip(clip, CommonMapping(from, to).Take(), to, {.ground = false}).motion;
  for (size_t frame = 0; frame < fitted.frames.size(); ++frame) {
    Pose& pose = fitted.frames[frame];
    pose.root_position.y() +=
        HeightAboveFloor(from, motion.frames[frame]) - HeightAboveFloor(to, pose);
  }
  return fitted;
}

Pose Retarget(const Skeleton& from, const Pose& pose, const Skeleton& to) {
  return Retarget(from, Motion{.frames = {pose}}, to).frames.front();
}

}  // namespace choreo
