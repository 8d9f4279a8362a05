#include "model/fit/sources.h"

#include "model/fit/mapping_builder.h"

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

double Out(const std::string& side) { return side == "left" ? 1.0 : -1.0; }

OurPoint Temple(const std::string& side) {
  return MappingBuilder::At("head", Out(side) * 0.055, 0.06, -0.02);
}

void AddTangTrunk(MappingBuilder& builder) {
  builder.Add("hips", "", {{"left_hip", 0.5}, {"right_hip", 0.5}},
              MappingBuilder::Between("left_hip", "right_hip"));
  builder.AddJoint("left_hip", "hips", "left_hip");
  builder.AddJoint("right_hip", "hips", "right_hip");
  // The waist is a point on the belly, 19 degrees in front of the hips' vertical in every genre.
  builder.Add("waist", "hips", {{"waist", 1.0}}, {MappingBuilder::At("pelvis", 0, 0.037, 0.027)},
              0.5);
  builder.Add("shoulders", "hips", {{"left_shoulder", 0.5}, {"right_shoulder", 0.5}},
              MappingBuilder::Between("left_shoulder", "right_shoulder"), 1, false);
}

void AddTangLimbs(MappingBuilder& builder, const std::string& side, const JointBlend& heel) {
  const double out = Out(side);
  const auto named = [&side](const char* part) { return side + "_" + part; };
  builder.AddJoint(named("shoulder"), "shoulders", named("shoulder"));
  builder.AddJoint(named("elbow"), named("shoulder"), named("elbow"));
  builder.AddJoint(named("wrist"), named("elbow"), named("wrist"));
  builder.AddJoint(named("hand"), named("wrist"), named("hand"), 0.7);
  builder.AddJoint(named("knee"), named("hip"), named("knee"));
  // The source's ankle is the outer ankle bone, which is why its heel seems to stand inwards.
  builder.Add(named("ankle"), named("knee"), {{named("ankle"), 1.0}},
              {MappingBuilder::At(named("ankle"), out * 0.03, 0, 0)});
  builder.Add(named("heel"), named("ankle"), heel,
              {MappingBuilder::At(named("ankle"), -out * 0.005, -0.05, -0.055)}, 0.5);
  builder.Add(named("toes"), named("ankle"), {{named("toes"), 1.0}}, {{.joint = named("foot")}});
}

}  // namespace

SourceMapping IdentitySource(const Skeleton& skeleton, double hands) {
  SourceMapping mapping;
  mapping.name = skeleton.name;
  mapping.accuracy_m = 0.002;
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
  for (const std::string side : {"left", "right"}) {
    builder.Add(side + "_temple", "head", {{side + "_temple", 1.0}}, {Temple(side)}, 0.5);
    AddTangLimbs(builder, side, {{side + "_heel", 1.0}});
    builder.AddFoot(side + "_toes");
    builder.AddFoot(side + "_heel");
  }
  return builder.Take();
}

SourceMapping Tang61Source() {
  MappingBuilder builder("tang61", kTangAccuracy);
  AddTangTrunk(builder);
  builder.Add("left_temple", "shoulders", {{"left_temple", 1.0}}, {Temple("left")});
  for (const std::string side : {"left", "right"}) {
    AddTangLimbs(builder, side, {{side + "_sole", 2.0}, {side + "_toes", -1.0}});
    builder.AddFoot(side + "_toes");
    builder.AddFoot(side + "_sole");
  }
  return builder.Take();
}

}  // namespace choreo
