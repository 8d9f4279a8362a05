#include "model/fit/sources/tang2018_skeleton.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "model/core/error.h"
#include "model/fit/sources/mapping_builder.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr double kWaistLean = 19 / kDegrees;

/// Mean over clips of the median distance of two points.
class Lengths {
 public:
  explicit Lengths(std::span<const PositionClip> clips) : clips_(clips) {
    if (clips.empty()) throw InvalidArgument("clips", "0 recordings, at least 1 is needed");
    for (const PositionClip& clip : clips) {
      if (clip.joint_names != Tang2018JointNames())
        throw InvalidArgument("clips", "the joints are not those of tang2018");
    }
  }

  double Between(const JointBlend& a, const JointBlend& b) const {
    double sum = 0;
    for (const PositionClip& clip : clips_) sum += MedianDistance(clip, a, b);
    const double length = sum / static_cast<double>(clips_.size());
    if (!(length > 0.005 && length < 1)) {
      throw InvalidArgument("clips", "from " + a[0].first + " to " + b[0].first + " it is " +
                                         std::to_string(length) + " m, no length of a body");
    }
    return length;
  }
  double Between(const std::string& a, const std::string& b) const {
    return Between(JointBlend{{a, 1.0}}, JointBlend{{b, 1.0}});
  }
  /// The mean of a bone on both sides.
  double OfBothSides(const std::string& a, const std::string& b) const {
    return 0.5 * (Between("left_" + a, "left_" + b) + Between("right_" + a, "right_" + b));
  }

 private:
  std::span<const PositionClip> clips_;
};

/// Position of a triangle's tip relative to its base, computed from the tip's distances to both
/// ends: along the base from its first end, and off it. A tip out of reach lies on the base.
struct Tip {
  double along, off;
};
Tip TipOver(double base, double from_first, double from_second) {
  const double along =
      (from_first * from_first + base * base - from_second * from_second) / (2 * base);
  return {along, std::sqrt(std::max(0.0, from_first * from_first - along * along))};
}

void AddBone(const std::string& name, const std::string& parent, const Eigen::Vector3d& offset,
             Skeleton& skeleton) {
  skeleton.AddJoint(name, skeleton.Find(parent), offset);
}

void AddLeg(const Lengths& lengths, const std::string& side, const Eigen::Vector3d& hip,
            Skeleton& skeleton) {
  AddBone(side + "hip", "waist", hip, skeleton);
  AddBone(side + "knee", side + "hip", {0, -lengths.OfBothSides("hip", "knee"), 0}, skeleton);
  AddBone(side + "ankle", side + "knee", {0, -lengths.OfBothSides("knee", "ankle"), 0}, skeleton);
  // Height of the ankle above a flat sole.
  const double sole = lengths.OfBothSides("heel", "toes");
  const Tip ankle =
      TipOver(sole, lengths.OfBothSides("heel", "ankle"), lengths.OfBothSides("toes", "ankle"));
  AddBone(side + "heel", side + "ankle", {0, -ankle.off, -ankle.along}, skeleton);
  AddBone(side + "toes", side + "ankle", {0, -ankle.off, sole - ankle.along}, skeleton);
}

void AddArm(const Lengths& lengths, const std::string& side, double out,
            const Eigen::Vector3d& shoulder, Skeleton& skeleton) {
  const auto between = [&](const char* a, const char* b) {
    return lengths.Between(side + a, side + b);
  };
  AddBone(side + "shoulder", "chest", shoulder, skeleton);
  AddBone(side + "elbow", side + "shoulder", {out * lengths.OfBothSides("shoulder", "elbow"), 0, 0},
          skeleton);
  const double wrist = between("elbow", "wrist");
  AddBone(side + "wrist", side + "elbow", {out * wrist, 0, 0}, skeleton);
  AddBone(side + "hand", side + "wrist", {out * between("wrist", "hand"), 0, 0}, skeleton);
  // Palms face down, so that thumbs point forward.
  const Tip thumb = TipOver(wrist, between("elbow", "thumb"), between("wrist", "thumb"));
  AddBone(side + "thumb", side + "wrist", {out * (thumb.along - wrist), 0, thumb.off}, skeleton);
}

}  // namespace

NativeTang2018 MeasureTang2018(std::span<const PositionClip> clips) {
  const Lengths lengths(clips);
  const JointBlend waist = {{"waist", 1.0}}, hips = {{"left_hip", 0.5}, {"right_hip", 0.5}},
                   shoulders = {{"left_shoulder", 0.5}, {"right_shoulder", 0.5}},
                   temples = {{"left_temple", 0.5}, {"right_temple", 0.5}};
  const double belly = lengths.Between(waist, hips);
  const double half_hips = 0.5 * lengths.Between("left_hip", "right_hip");
  const double half_shoulders = 0.5 * lengths.Between("left_shoulder", "right_shoulder");
  const double half_head = 0.5 * lengths.Between("left_temple", "right_temple");
  const double half_neck = 0.5 * lengths.Between(shoulders, temples);
  // The chest joint is above the hips, as the shoulders are, at their recorded distance from the
  // waist.
  const double depth = belly * std::sin(kWaistLean);
  const double reach = lengths.Between(waist, shoulders);
  const double trunk = std::sqrt(std::max(0.0, reach * reach - depth * depth));

  NativeTang2018 native;
  Skeleton& skeleton = native.skeleton;
  skeleton.name = "tang2018";
  AddBone("waist", "", Eigen::Vector3d::Zero(), skeleton);
  for (const double out : {1.0, -1.0}) {
    AddLeg(lengths, out > 0 ? "left_" : "right_",
           {out * half_hips, -belly * std::cos(kWaistLean), -depth}, skeleton);
  }
  AddBone("chest", "waist", {0, 0, -depth}, skeleton);
  AddBone("head", "chest", {0, trunk + half_neck, 0}, skeleton);
  for (const double out : {1.0, -1.0}) {
    AddArm(lengths, out > 0 ? "left_" : "right_", out, {out * half_shoulders, trunk, 0}, skeleton);
  }
  skeleton.AssignRoles();
  skeleton.StandOnFloor();

  MappingBuilder mapping("tang2018", kTangAccuracy);
  mapping.AddHips("left_hip", "right_hip");
  mapping.AddJoint("waist", "hips", "waist");
  mapping.Add("shoulders", "waist", shoulders,
              MappingBuilder::Between("left_shoulder", "right_shoulder"), 1, false);
  mapping.Add("temples", "shoulders", temples, {MappingBuilder::At("head", 0, half_neck, 0)});
  for (const double out : {1.0, -1.0}) {
    const std::string side = out > 0 ? "left_" : "right_";
    mapping.Add(side + "temple", "temples", {{side + "temple", 1.0}},
                {MappingBuilder::At("head", out * half_head, half_neck, 0)}, 0.5);
    const auto bone = [&](const char* joint, const std::string& parent, double weight) {
      mapping.AddJoint(side + joint, parent, side + joint, weight);
    };
    bone("shoulder", "shoulders", 1);
    bone("elbow", side + "shoulder", 1);
    bone("wrist", side + "elbow", 1);
    bone("hand", side + "wrist", 0.7);
    bone("thumb", side + "wrist", 0.3);
    bone("knee", side + "hip", 1);
    bone("ankle", side + "knee", 1);
    bone("heel", side + "ankle", 0.5);
    bone("toes", side + "ankle", 1);
    mapping.AddFoot(side + "toes");
    mapping.AddFoot(side + "heel");
  }
  native.mapping = mapping.Take();
  return native;
}

}  // namespace choreo
