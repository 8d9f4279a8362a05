#include "model/fit/rig_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "model/fit/rig_reading.h"
#include "model/fit/solver/fit_clip.h"
#include "model/fit/sources/sources.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/mirror.h"
#include "model/motion/pose/pose_faults.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

const Skeleton& SmplBody() { return Skeleton::Smpl24(); }

Eigen::Matrix3d Turning(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

// Exchanges the left and right bones of the "body", its "arms" or its "legs".
HumanBones Exchanged(const HumanBones& bones, const std::string& of) {
  HumanBones exchanged{.rig = bones.rig, .bones = {}};
  for (const auto& [bone, index] : bones.bones) {
    const bool leg = bone.ends_with("_hip") || bone.ends_with("_knee") ||
                     bone.ends_with("_ankle") || bone.ends_with("_foot");
    const bool counts = of == "body" || (of == "legs") == leg;
    exchanged.bones[counts ? OtherSide(bone) : bone] = index;
  }
  return exchanged;
}

// The share of frames in which a joint bends impossibly.
double ShareBent(const Motion& motion) {
  const auto bent = std::ranges::count_if(
      motion.frames, [](const Pose& pose) { return !BendFaults(SmplBody(), pose).empty(); });
  return static_cast<double>(bent) / static_cast<double>(motion.frames.size());
}

class RigFitter {
 public:
  RigFitter(const RigReading& reading, double scale)
      : reading_(reading),
        rig_(reading.rig()),
        spine_(rig_.bones.Spine()),
        scale_(scale > 0 ? scale : reading.Scale()) {}

  RigFit Fit() {
    const std::optional<RigReading::Rest> rest = reading_.FindRest();
    RigFit fit;
    fit.missing = reading_.Missing();
    fit.turns = reading_.TurnsCarry();
    fit.rest = rest.has_value();
    fit.up = reading_.Up();
    if (!fit.turns || !rest) {
      fit.motion = FitPositions();
      if (!fit.turns) return fit;
      Calibrate(fit.motion);
    } else {
      TakeRest(*rest);
    }
    fit.motion = CopyTurns();
    return fit;
  }

 private:
  int Find(const std::string& bone) const { return rig_.bones.Find(bone); }
  static Eigen::Vector3d Place(const RigPlacement& placement, int bone) {
    return placement.places.col(bone);
  }

  // Fits positions alone.
  Motion FitPositions() const {
    PositionClip clip;
    clip.fps = rig_.fps;
    clip.joint_names = rig_.names;
    for (int64_t frame = 0; frame < rig_.count; ++frame)
      clip.frames.push_back(rig_.frame(frame).places);
    return FitClip(clip, RigSource(clip, rig_.bones), SmplBody(), {.ground = false}).motion;
  }

  // Sets the rotations from SMPL's rest, in the world, to each bone's own frame.
  void TakeRest(const RigReading::Rest& found) {
    const CharacterBody& rest = found.body;
    frames_.assign(rig_.names.size(), Eigen::Matrix3d::Identity());
    for (size_t joint = 0; joint < rest.nodes.size(); ++joint) {
      const int bone = rest.nodes[joint];
      if (bone < 0) continue;
      // A foot is flat at rest in both; toe joints lie more or less beside the foot's direction.
      const std::string& name = rest.skeleton.joint_names[joint];
      const bool foot = name.ends_with("_ankle") || name.ends_with("_foot");
      const Eigen::Matrix3d& turn = rest.turns[foot ? 0 : joint];
      frames_[bone] = found.placement->turns[bone].transpose() * turn.transpose();
    }
  }

  // Estimates the same rotations, which should be constant, from a fit to positions.
  void Calibrate(const Motion& fitted) {
    std::vector<Eigen::Matrix3d> sums(rig_.names.size(), Eigen::Matrix3d::Zero());
    for (int64_t frame = 0; frame < rig_.count; ++frame) {
      const JointPlacement ours = ForwardKinematics(SmplBody(), fitted.frames[frame]);
      const RigPlacement theirs = rig_.frame(frame);
      const auto add = [&](int bone, const Eigen::Matrix3d& turn) {
        if (bone >= 0) sums[bone] += theirs.turns[bone].transpose() * turn;
      };
      for (int joint = 0; joint < SmplBody().joints(); ++joint) {
        const std::string& name = SmplBody().joint_names[joint];
        if (!name.starts_with("spine") && name != "neck") add(Find(name), ours.rotations[joint]);
      }
      for (size_t i = 0; i < spine_.size(); ++i)
        add(Find(spine_[i]), OurSpine(ours, static_cast<double>(i + 1) / std::ssize(spine_)));
      for (const std::string& neck : rig_.bones.Neck())
        add(Find(neck), ours.rotations[SmplBody().Find("neck")]);
    }
    frames_.clear();
    for (const Eigen::Matrix3d& sum : sums) {
      frames_.push_back(sum.isZero() ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                     : NearestRotation(sum));
    }
  }

  // The rotation of our trunk at `share` of the way from pelvis to chest.
  static Eigen::Matrix3d OurSpine(const JointPlacement& ours, double share) {
    static const int joints[] = {0, SmplBody().Find("spine1"), SmplBody().Find("spine2"),
                                 SmplBody().Find("spine3")};
    const double way = 3 * share;
    const int below = std::min(2, static_cast<int>(way));
    return SlerpMatrix(ours.rotations[joints[below]], ours.rotations[joints[below + 1]],
                       way - below);
  }

  // The same for the rig's trunk.
  Eigen::Matrix3d TheirSpine(const RigPlacement& theirs, double share) const {
    const double way = share * static_cast<double>(spine_.size());
    const auto below = std::min(static_cast<size_t>(way), spine_.size());
    const auto turn = [&](size_t i) { return Turn(theirs, i == 0 ? "pelvis" : spine_[i - 1]); };
    if (below == spine_.size()) return turn(below);
    return SlerpMatrix(turn(below), turn(below + 1), way - static_cast<double>(below));
  }

  // World rotation of our joint for that bone.
  Eigen::Matrix3d Turn(const RigPlacement& theirs, const std::string& bone) const {
    const int index = Find(bone);
    return theirs.turns[index] * frames_[index];
  }

  std::vector<Eigen::Matrix3d> WorldTurns(const RigPlacement& theirs) const {
    std::vector<Eigen::Matrix3d> turns(static_cast<size_t>(SmplBody().joints()));
    const std::vector<std::string> necks = rig_.bones.Neck();
    for (int joint = 0; joint < SmplBody().joints(); ++joint) {
      const std::string& name = SmplBody().joint_names[joint];
      const int parent = SmplBody().parents[joint];
      if (name.starts_with("spine")) {
        turns[joint] = TheirSpine(theirs, (name.back() - '0') / 3.0);
      } else if (name == "neck") {
        turns[joint] = !necks.empty()      ? Turn(theirs, necks[necks.size() / 2])
                       : Find("head") >= 0 ? SlerpMatrix(turns[parent], Turn(theirs, "head"), 0.5)
                                           : turns[parent];
      } else if (name == "head" && Find("head") < 0 && !necks.empty()) {
        turns[joint] = Turn(theirs, necks.back());
      } else if (Find(name) >= 0 && !name.ends_with("_hand")) {
        turns[joint] = Turn(theirs, name);
      } else {
        turns[joint] = turns[parent];
      }
    }
    // Limbs point where the rig's do, even if the file moves them without rotations.
    for (const LimbSegment& segment : LimbSegments()) {
      const Eigen::Vector3d bone = reading_.Bone(theirs, segment);
      if (bone.norm() * scale_ < 1e-6) continue;
      Eigen::Matrix3d& turn = turns[SmplBody().Find(segment.from)];
      const Eigen::Vector3d ours = SmplBody().offsets.col(SmplBody().Find(segment.to));
      turn = Turning(turn * ours, bone) * turn;
    }
    return turns;
  }

  Motion CopyTurns() const {
    Motion motion{.fps = rig_.fps, .frames = {}};
    const Eigen::Vector3d middle = (SmplBody().offsets.col(SmplBody().left_hip) +
                                    SmplBody().offsets.col(SmplBody().right_hip)) /
                                   2;
    for (int64_t frame = 0; frame < rig_.count; ++frame) {
      const RigPlacement theirs = rig_.frame(frame);
      const std::vector<Eigen::Matrix3d> turns = WorldTurns(theirs);
      Pose& pose = motion.frames.emplace_back();
      pose.rotations.resize(3, SmplBody().joints());
      for (int joint = 0; joint < SmplBody().joints(); ++joint) {
        const int parent = SmplBody().parents[joint];
        pose.rotations.col(joint) = LogMap(
            parent < 0 ? turns[joint] : Eigen::Matrix3d(turns[parent].transpose() * turns[joint]));
      }
      const Eigen::Vector3d hips =
          scale_ * (Place(theirs, Find("left_hip")) + Place(theirs, Find("right_hip"))) / 2;
      pose.root_position = hips - turns[0] * middle;
    }
    MakeContinuous(motion);
    return motion;
  }

  const RigReading& reading_;
  const RigMotion& rig_;
  const std::vector<std::string> spine_;
  std::vector<Eigen::Matrix3d> frames_;  // [bones]
  double scale_;
};

}  // namespace

RigFit FitRig(const RigMotion& rig, double scale) {
  const RigReading as_named(rig);
  const auto named = [&] { return RigFitter(as_named, scale).Fit(); };
  // Toes show the front; without them, knees and elbows do.
  const bool has_toes = as_named.Find("left_foot") >= 0 && as_named.Find("right_foot") >= 0;
  if (as_named.Stands() && has_toes) return named();
  std::optional<RigFit> as_it_is;
  if (as_named.Stands()) {
    as_it_is = named();
    if (ShareBent(as_it_is->motion) <= kRuleShare) return *std::move(as_it_is);
  }
  for (const std::string of : {"body", "arms", "legs"}) {
    RigMotion other = rig;
    other.bones = Exchanged(rig.bones, of);
    const RigReading as_placed(other);
    if (!as_placed.Stands()) continue;
    RigFit fit = RigFitter(as_placed, scale).Fit();
    if (as_it_is && ShareBent(fit.motion) > 1 - kRuleShare) continue;
    fit.exchanged = of;
    return fit;
  }
  return as_it_is ? *std::move(as_it_is) : named();
}

}  // namespace choreo
