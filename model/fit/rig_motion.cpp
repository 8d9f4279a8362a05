#include "model/fit/rig_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "model/core/error.h"
#include "model/core/quantile.h"
#include "model/fit/fit_clip.h"
#include "model/fit/sources.h"
#include "model/motion/kinematics.h"
#include "model/motion/rotation.h"
#include "model/motion/skeleton.h"

namespace choreo {
namespace {

constexpr int64_t kSamples = 200;  // frames that tell what is constant
// How far the rest pose's limbs may be from SMPL's, radians: legs hang, arms are anywhere between
// hanging and held out.
constexpr double kLegsAside = 50 / kDegrees, kArmsAside = 115 / kDegrees;
constexpr double kTrunkAside = 35 / kDegrees;
// A bone that carries the next one has it in the same place, radians and bones.
constexpr double kLooseBone = 15 / kDegrees;
constexpr int kMostLoose = 2;
constexpr double kMostFrames = 0.9;

const Skeleton& OurBody() { return Skeleton::Smpl24(); }

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Matrix3d Turning(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

Eigen::Matrix3d Blend(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b, double share) {
  return Eigen::Quaterniond(a).slerp(share, Eigen::Quaterniond(b)).toRotationMatrix();
}

// Of the six axes.
Eigen::Vector3d NearestAxis(const Eigen::Vector3d& way) {
  Eigen::Index axis = 0;
  way.cwiseAbs().maxCoeff(&axis);
  return Eigen::Vector3d::Unit(axis) * (way[axis] < 0 ? -1 : 1);
}

// Left is right, and right is left.
HumanBones Exchanged(const HumanBones& bones) {
  HumanBones exchanged{.rig = bones.rig, .bones = {}};
  for (const auto& [bone, index] : bones.bones) {
    const bool left = bone.starts_with("left_"), right = bone.starts_with("right_");
    exchanged.bones[left    ? "right_" + bone.substr(5)
                    : right ? "left_" + bone.substr(6)
                            : bone] = index;
  }
  return exchanged;
}

/// The bones whose ends say where they point: by SMPL's names, which are HumanBones', too.
struct Segment {
  std::string from, to;
};
const std::vector<Segment>& LimbSegments() {
  static const std::vector<Segment> segments = [] {
    std::vector<Segment> all;
    for (const std::string side : {"left_", "right_"}) {
      for (const auto& [from, to] : {std::pair("hip", "knee"), std::pair("knee", "ankle"),
                                     std::pair("shoulder", "elbow"), std::pair("elbow", "wrist")})
        all.push_back({side + from, side + to});
    }
    return all;
  }();
  return segments;
}

class RigFitter {
 public:
  RigFitter(const RigMotion& rig, double scale) : rig_(rig), spine_(rig.bones.Spine()) {
    if (rig.count < 1) throw InvalidArgument("", "has no frames");
    if (const std::string missing = MissingBone(rig.bones); !missing.empty())
      throw InvalidArgument("bones", "none of them is the " + missing);
    const int64_t step = std::max<int64_t>(1, rig.count / kSamples);
    for (int64_t frame = 0; frame < rig.count; frame += step) samples_.push_back(rig.frame(frame));
    for (const RigPlacement& sample : samples_) {
      const bool finite =
          sample.places.allFinite() &&
          std::ranges::all_of(sample.turns, [](const auto& t) { return t.allFinite(); });
      if (!finite) throw InvalidArgument("bones", "stand or turn in ways that are not finite");
    }
    scale_ = scale > 0 ? scale : Scale();
  }

  // Whether one of its rest poses is a standing body's.
  bool Stands() const {
    return std::ranges::any_of(rig_.rests, [&](const RigPlacement& rest) {
      return Agrees(rest) && RestBody(rig_.bones, rest.places).has_value();
    });
  }

  RigFit Fit() {
    RigFit fit;
    fit.missing = Missing();
    fit.turns = TurnsCarry();
    const RigPlacement* stands = nullptr;
    std::optional<CharacterBody> rest;
    for (size_t i = 0; i < rig_.rests.size() && !rest; ++i) {
      stands = &rig_.rests[i];
      if (Agrees(*stands)) rest = RestBody(rig_.bones, stands->places);
    }
    if (!rest && IsHeldOut(samples_[0])) {
      // Some begin with the pose that others rest in.
      stands = &samples_[0];
      rest = RestBody(rig_.bones, stands->places);
    }
    fit.rest = rest.has_value();
    fit.up = Up();
    if (!fit.turns || !rest) {
      fit.motion = FitPositions();
      if (!fit.turns) return fit;
      Calibrate(fit.motion);
    } else {
      TakeRest(*rest, *stands);
    }
    fit.motion = CopyTurns();
    return fit;
  }

 private:
  int Find(const std::string& bone) const { return rig_.bones.Find(bone); }
  static Eigen::Vector3d Place(const RigPlacement& placement, int bone) {
    return placement.places.col(bone);
  }
  Eigen::Vector3d Bone(const RigPlacement& placement, const Segment& segment) const {
    return Place(placement, Find(segment.to)) - Place(placement, Find(segment.from));
  }

  double Scale() const {
    double ours = 0, theirs = 0;
    for (const Segment& segment : LimbSegments()) {
      if (!segment.to.ends_with("knee") && !segment.to.ends_with("ankle")) continue;
      std::vector<double> lengths;
      for (const RigPlacement& sample : samples_) lengths.push_back(Bone(sample, segment).norm());
      theirs += Median(std::move(lengths));
      ours += OurBody().offsets.col(OurBody().Find(segment.to)).norm();
    }
    if (!(theirs > 1e-9) || !std::isfinite(ours / theirs))
      throw InvalidArgument("bones", "its legs have no length: all stand in one place");
    return ours / theirs;
  }

  std::vector<std::string> Missing() const {
    std::vector<std::string> missing;
    if (Find("neck") < 0) missing.emplace_back("neck");
    if (Find("head") < 0) missing.emplace_back("head");
    if (Find("left_collar") < 0 || Find("right_collar") < 0) missing.emplace_back("collars");
    if (Find("left_foot") < 0 || Find("right_foot") < 0) missing.emplace_back("toes");
    if (spine_.empty()) missing.emplace_back("spine");
    return missing;
  }

  // Where a bone points in its own frame.
  Eigen::Vector3d Inside(const RigPlacement& placement, const Segment& segment) const {
    const Eigen::Vector3d bone = Bone(placement, segment);
    return (placement.turns[Find(segment.from)].transpose() * bone).normalized();
  }

  // Whether nearly all limbs point, each in its own frame, where `expected` says in most frames.
  bool Point(const std::function<Eigen::Vector3d(const Segment&)>& expected, double share) const {
    int loose = 0;
    for (const Segment& segment : LimbSegments()) {
      const Eigen::Vector3d there = expected(segment);
      std::vector<double> angles;
      for (const RigPlacement& sample : samples_)
        angles.push_back(AngleBetween(Inside(sample, segment), there));
      loose += Quantile(std::move(angles), share) > kLooseBone ? 1 : 0;
    }
    return loose <= kMostLoose;
  }

  // Whether the place of a bone's end turns with the bone, as it does unless somebody has moved
  // joints without turning anything.
  bool TurnsCarry() const {
    return Point(
        [&](const Segment& segment) {
          Eigen::Vector3d mean = Eigen::Vector3d::Zero();
          for (const RigPlacement& sample : samples_) mean += Inside(sample, segment);
          return mean;
        },
        kMostFrames);
  }

  // Whether the rest pose is that of the bones which then turn.
  bool Agrees(const RigPlacement& rest) const {
    return Point([&](const Segment& segment) { return Inside(rest, segment); }, 0.5);
  }

  // Whether arms and legs are straight and the arms held out.
  bool IsHeldOut(const RigPlacement& placement) const {
    for (const std::string side : {"left_", "right_"}) {
      for (const auto& [upper, middle, end] :
           {std::tuple("hip", "knee", "ankle"), std::tuple("shoulder", "elbow", "wrist")}) {
        if (AngleBetween(Bone(placement, {side + upper, side + middle}),
                         Bone(placement, {side + middle, side + end})) > kLooseBone)
          return false;
      }
    }
    return AngleBetween(Bone(placement, {"left_shoulder", "left_elbow"}),
                        Bone(placement, {"right_elbow", "right_shoulder"})) < 2 * kLooseBone;
  }

  // Along which axis of the file's a rest pose stands.
  std::optional<Eigen::Vector3d> Up() const {
    for (size_t i = rig_.rests_apart; i < rig_.rests.size(); ++i) {
      if (!Agrees(rig_.rests[i])) continue;
      if (const auto body = RestBody(rig_.bones, rig_.rests[i].places))
        return NearestAxis(body->turns[0].row(1).transpose());
    }
    return std::nullopt;
  }

  // As before rotations were looked at.
  Motion FitPositions() const {
    PositionClip clip;
    clip.fps = rig_.fps;
    clip.joint_names = rig_.names;
    for (int64_t frame = 0; frame < rig_.count; ++frame)
      clip.frames.push_back(rig_.frame(frame).places);
    return FitClip(clip, RigSource(clip, rig_.bones), OurBody(), {.ground = false}).motion;
  }

  // What leads from SMPL's rest, in the world, to the bone's own frame.
  void TakeRest(const CharacterBody& rest, const RigPlacement& stands) {
    frames_.assign(rig_.names.size(), Eigen::Matrix3d::Identity());
    for (size_t joint = 0; joint < rest.nodes.size(); ++joint) {
      const int bone = rest.nodes[joint];
      if (bone < 0) continue;
      // A foot is flat at rest, here and there; toe joints stand more or less aside of where it
      // points.
      const std::string& name = rest.skeleton.joint_names[joint];
      const bool foot = name.ends_with("_ankle") || name.ends_with("_foot");
      const Eigen::Matrix3d& turn = rest.turns[foot ? 0 : joint];
      frames_[bone] = stands.turns[bone].transpose() * turn.transpose();
    }
  }

  // The same, as constant as it can be, from a fit to positions.
  void Calibrate(const Motion& fitted) {
    std::vector<Eigen::Matrix3d> sums(rig_.names.size(), Eigen::Matrix3d::Zero());
    for (int64_t frame = 0; frame < rig_.count; ++frame) {
      const JointPlacement ours = ForwardKinematics(OurBody(), fitted.frames[frame]);
      const RigPlacement theirs = rig_.frame(frame);
      const auto add = [&](int bone, const Eigen::Matrix3d& turn) {
        if (bone >= 0) sums[bone] += theirs.turns[bone].transpose() * turn;
      };
      for (int joint = 0; joint < OurBody().joints(); ++joint) {
        const std::string& name = OurBody().joint_names[joint];
        if (!name.starts_with("spine") && name != "neck") add(Find(name), ours.rotations[joint]);
      }
      for (size_t i = 0; i < spine_.size(); ++i)
        add(Find(spine_[i]), OurSpine(ours, static_cast<double>(i + 1) / std::ssize(spine_)));
      for (const std::string& neck : rig_.bones.Neck())
        add(Find(neck), ours.rotations[OurBody().Find("neck")]);
    }
    frames_.clear();
    for (const Eigen::Matrix3d& sum : sums) {
      frames_.push_back(sum.isZero() ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                     : NearestRotation(sum));
    }
  }

  // Our trunk's turn, `share` of the way from the pelvis to the chest.
  static Eigen::Matrix3d OurSpine(const JointPlacement& ours, double share) {
    static const int joints[] = {0, OurBody().Find("spine1"), OurBody().Find("spine2"),
                                 OurBody().Find("spine3")};
    const double way = 3 * share;
    const int below = std::min(2, static_cast<int>(way));
    return Blend(ours.rotations[joints[below]], ours.rotations[joints[below + 1]], way - below);
  }

  // The rig's trunk's.
  Eigen::Matrix3d TheirSpine(const RigPlacement& theirs, double share) const {
    const double way = share * static_cast<double>(spine_.size());
    const auto below = std::min(static_cast<size_t>(way), spine_.size());
    const auto turn = [&](size_t i) { return Turn(theirs, i == 0 ? "pelvis" : spine_[i - 1]); };
    if (below == spine_.size()) return turn(below);
    return Blend(turn(below), turn(below + 1), way - static_cast<double>(below));
  }

  // How our joint of that bone is turned in the world.
  Eigen::Matrix3d Turn(const RigPlacement& theirs, const std::string& bone) const {
    const int index = Find(bone);
    return theirs.turns[index] * frames_[index];
  }

  std::vector<Eigen::Matrix3d> WorldTurns(const RigPlacement& theirs) const {
    std::vector<Eigen::Matrix3d> turns(static_cast<size_t>(OurBody().joints()));
    const std::vector<std::string> necks = rig_.bones.Neck();
    for (int joint = 0; joint < OurBody().joints(); ++joint) {
      const std::string& name = OurBody().joint_names[joint];
      const int parent = OurBody().parents[joint];
      if (name.starts_with("spine")) {
        turns[joint] = TheirSpine(theirs, (name.back() - '0') / 3.0);
      } else if (name == "neck") {
        turns[joint] = !necks.empty()      ? Turn(theirs, necks[necks.size() / 2])
                       : Find("head") >= 0 ? Blend(turns[parent], Turn(theirs, "head"), 0.5)
                                           : turns[parent];
      } else if (name == "head" && Find("head") < 0 && !necks.empty()) {
        turns[joint] = Turn(theirs, necks.back());
      } else if (Find(name) >= 0 && !name.ends_with("_hand")) {
        turns[joint] = Turn(theirs, name);
      } else {
        turns[joint] = turns[parent];
      }
    }
    // Limbs point where theirs do, whatever moved them there.
    for (const Segment& segment : LimbSegments()) {
      const Eigen::Vector3d bone = Bone(theirs, segment);
      if (bone.norm() * scale_ < 1e-6) continue;
      Eigen::Matrix3d& turn = turns[OurBody().Find(segment.from)];
      const Eigen::Vector3d ours = OurBody().offsets.col(OurBody().Find(segment.to));
      turn = Turning(turn * ours, bone) * turn;
    }
    return turns;
  }

  Motion CopyTurns() const {
    Motion motion{.fps = rig_.fps, .frames = {}};
    const Eigen::Vector3d middle =
        (OurBody().offsets.col(OurBody().left_hip) + OurBody().offsets.col(OurBody().right_hip)) /
        2;
    for (int64_t frame = 0; frame < rig_.count; ++frame) {
      const RigPlacement theirs = rig_.frame(frame);
      const std::vector<Eigen::Matrix3d> turns = WorldTurns(theirs);
      Pose& pose = motion.frames.emplace_back();
      pose.rotations.resize(3, OurBody().joints());
      for (int joint = 0; joint < OurBody().joints(); ++joint) {
        const int parent = OurBody().parents[joint];
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

  const RigMotion& rig_;
  const std::vector<std::string> spine_;
  std::vector<RigPlacement> samples_;
  std::vector<Eigen::Matrix3d> frames_;  // [bones]
  double scale_ = 1;
};

}  // namespace

std::optional<CharacterBody> RestBody(const HumanBones& bones, const Eigen::Matrix3Xd& places) {
  std::optional<CharacterBody> body;
  try {
    body = MakeCharacterBody(bones, places);
  } catch (const Error&) {
    return std::nullopt;
  }
  const Eigen::Matrix3d upright = body->turns[0];
  const auto place = [&](const std::string& bone) -> Eigen::Vector3d {
    return upright * places.col(bones.Find(bone));
  };
  const Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d trunk =
      place("left_shoulder") + place("right_shoulder") - place("left_hip") - place("right_hip");
  if (AngleBetween(trunk, up) > kTrunkAside) return std::nullopt;
  const Eigen::Matrix3Xd rest = JointPositions(OurBody(), RestPose(OurBody()));
  for (const Segment& segment : LimbSegments()) {
    const Eigen::Vector3d ours =
        rest.col(OurBody().Find(segment.to)) - rest.col(OurBody().Find(segment.from));
    const bool leg = segment.to.ends_with("knee") || segment.to.ends_with("ankle");
    const double aside = AngleBetween(place(segment.to) - place(segment.from), ours);
    if (aside > (leg ? kLegsAside : kArmsAside)) return std::nullopt;
  }
  if (bones.Find("head") >= 0 && bones.Find("neck") >= 0 &&
      (place("head") - place("neck")).dot(up) < 0)
    return std::nullopt;
  return body;
}

RigFit FitRig(const RigMotion& rig, double scale) {
  RigFitter as_named(rig, scale);
  if (as_named.Stands()) return as_named.Fit();
  RigMotion mirrored = rig;
  mirrored.bones = Exchanged(rig.bones);
  RigFitter as_placed(mirrored, scale);
  if (!as_placed.Stands()) return as_named.Fit();
  RigFit fit = as_placed.Fit();
  fit.exchanged = true;
  return fit;
}

}  // namespace choreo
