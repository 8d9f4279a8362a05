#include "model/fit/sources/sources.h"

#include "model/core/numbers/quantile.h"
#include "model/fit/sources/mapping_builder.h"

namespace choreo {
namespace {

bool IsBelowWrist(const Skeleton& skeleton, int joint) {
  const auto is_wrist = [&](int parent) {
    const int elbow = skeleton.parents[parent];
    return elbow >= 0 && (elbow == skeleton.left_elbow || elbow == skeleton.right_elbow);
  };
  int parent = skeleton.parents[joint];
  while (parent >= 0 && !is_wrist(parent)) parent = skeleton.parents[parent];
  return parent >= 0;
}

double Out(const std::string& side) { return side == "left_" ? 1.0 : -1.0; }

OurPoint Temple(const std::string& side) {
  return MappingBuilder::At("head", Out(side) * 0.055, 0.06, -0.02);
}

void AddTangTrunk(MappingBuilder& builder) {
  builder.AddHips("left_hip", "right_hip");
  // The waist is a point on the belly, 19 degrees in front of the hips' vertical in every genre.
  builder.Add("waist", "hips", {{"waist", 1.0}}, {MappingBuilder::At("pelvis", 0, 0.037, 0.027)},
              0.5);
  builder.Add("shoulders", "hips", {{"left_shoulder", 0.5}, {"right_shoulder", 0.5}},
              MappingBuilder::Between("left_shoulder", "right_shoulder"), 1, false);
}

void AddTangLimbs(MappingBuilder& builder, const std::string& side, const JointBlend& heel) {
  const double out = Out(side);
  builder.AddJoint(side + "shoulder", "shoulders", side + "shoulder");
  builder.AddJoint(side + "elbow", side + "shoulder", side + "elbow");
  builder.AddJoint(side + "wrist", side + "elbow", side + "wrist");
  builder.AddJoint(side + "hand", side + "wrist", side + "hand", 0.7);
  builder.AddJoint(side + "knee", side + "hip", side + "knee");
  // The source's ankle is the outer ankle bone, so its heel seems to stand inwards.
  builder.Add(side + "ankle", side + "knee", {{side + "ankle", 1.0}},
              {MappingBuilder::At(side + "ankle", out * 0.03, 0, 0)});
  builder.Add(side + "heel", side + "ankle", heel,
              {MappingBuilder::At(side + "ankle", -out * 0.005, -0.05, -0.055)}, 0.5);
  builder.Add(side + "toes", side + "ankle", {{side + "toes", 1.0}}, {{.joint = side + "foot"}});
}

}  // namespace

double MedianDistance(const PositionClip& clip, const JointBlend& a, const JointBlend& b) {
  const auto point = [&clip](const JointBlend& blend, const Eigen::Matrix3Xd& frame) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [name, weight] : blend)
      sum += weight * frame.col(IndexOf(clip.joint_names, name));
    return sum;
  };
  std::vector<double> distances;
  for (const Eigen::Matrix3Xd& frame : clip.frames) {
    distances.push_back((point(a, frame) - point(b, frame)).norm());
  }
  return Median(std::move(distances));
}

SourceMapping IdentitySource(const Skeleton& skeleton, double hands) {
  SourceMapping mapping{.name = skeleton.name, .landmarks = {}, .accuracy_m = 0.002, .feet = {}};
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const std::string& name = skeleton.joint_names[joint];
    mapping.landmarks.push_back({.name = name,
                                 .source = {{name, 1.0}},
                                 .ours = {{.joint = name}},
                                 .parent = skeleton.parents[joint],
                                 .weight = IsBelowWrist(skeleton, joint) ? hands : 1});
  }
  for (const int foot : skeleton.feet) {
    if (foot >= 0) mapping.feet.push_back(skeleton.joint_names[foot]);
  }
  return mapping;
}

const std::vector<std::string>& Tang2018JointNames() {
  static const std::vector<std::string> names = {
      "right_temple",  "left_temple", "waist",      "right_shoulder", "right_elbow", "right_wrist",
      "right_hand",    "right_hip",   "right_knee", "right_ankle",    "right_heel",  "right_toes",
      "left_shoulder", "left_elbow",  "left_wrist", "left_hand",      "left_hip",    "left_knee",
      "left_ankle",    "left_heel",   "left_toes",  "left_thumb",     "right_thumb"};
  return names;
}

const std::vector<std::string>& Tang61JointNames() {
  static const std::vector<std::string> names = {
      "waist",         "neck",       "left_temple", "right_shoulder", "right_elbow", "right_wrist",
      "right_hand",    "right_hip",  "right_knee",  "right_ankle",    "right_sole",  "right_toes",
      "left_shoulder", "left_elbow", "left_wrist",  "left_hand",      "left_hip",    "left_knee",
      "left_ankle",    "left_sole",  "left_toes"};
  return names;
}

SourceMapping Tang2018Source() {
  MappingBuilder builder("tang2018", kTangAccuracy);
  AddTangTrunk(builder);
  builder.Add("head", "shoulders", {{"left_temple", 0.5}, {"right_temple", 0.5}},
              {MappingBuilder::At("head", 0, 0.06, -0.02)});
  for (const std::string side : {"left_", "right_"}) {
    builder.Add(side + "temple", "head", {{side + "temple", 1.0}}, {Temple(side)}, 0.5);
    AddTangLimbs(builder, side, {{side + "heel", 1.0}});
    builder.AddFoot(side + "toes");
    builder.AddFoot(side + "heel");
  }
  return builder.Take();
}

SourceMapping Tang61Source() {
  MappingBuilder builder("tang61", kTangAccuracy);
  AddTangTrunk(builder);
  builder.Add("left_temple", "shoulders", {{"left_temple", 1.0}}, {Temple("left_")});
  for (const std::string side : {"left_", "right_"}) {
    AddTangLimbs(builder, side, {{side + "sole", 2.0}, {side + "toes", -1.0}});
    builder.AddFoot(side + "toes");
    builder.AddFoot(side + "sole");
  }
  return builder.Take();
}

}  // namespace choreo
