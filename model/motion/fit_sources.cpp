#include "model/motion/fit_sources.h"

#include <algorithm>
#include <initializer_list>
#include <optional>

#include "model/core/error.h"

namespace choreo {
namespace {

// Builds a mapping landmark by landmark; parents are named.
class MappingBuilder {
 public:
  explicit MappingBuilder(std::string name) { mapping_.name = std::move(name); }

  void Add(const std::string& name, const std::string& parent, JointBlend source,
           std::vector<OurPoint> ours, double weight = 1, bool rigid = true) {
    int index = -1;
    for (size_t i = 0; i < mapping_.landmarks.size(); ++i) {
      if (mapping_.landmarks[i].name == parent) index = static_cast<int>(i);
    }
    mapping_.landmarks.push_back({.name = name,
                                  .source = std::move(source),
                                  .ours = std::move(ours),
                                  .parent = index,
                                  .rigid = rigid,
                                  .weight = weight});
  }
  // A joint that both skeletons have.
  void AddJoint(const std::string& ours, const std::string& parent, const std::string& source,
                double weight = 1) {
    Add(ours, parent, {{source, 1.0}}, {{.joint = ours}}, weight);
  }

  SourceMapping mapping_;
};

OurPoint At(const std::string& joint, double x, double y, double z, double weight = 1) {
  return {.joint = joint, .weight = weight, .offset = {x, y, z}};
}

// Our left is +x.
double Outwards(const std::string& side) { return side == "left" ? 1.0 : -1.0; }

}  // namespace

SourceMapping IdentitySource(const Skeleton& skeleton) {
  SourceMapping mapping;
  mapping.name = skeleton.name;
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    const std::string& name = skeleton.joint_names[joint];
    mapping.landmarks.push_back({.name = name,
                                 .source = {{name, 1.0}},
                                 .ours = {{.joint = name}},
                                 .parent = skeleton.parents[joint]});
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

SourceMapping Tang2018Source() {
  MappingBuilder builder("tang2018");
  builder.Add("hips", "", {{"left_hip", 0.5}, {"right_hip", 0.5}},
              {{.joint = "left_hip", .weight = 0.5}, {.joint = "right_hip", .weight = 0.5}});
  builder.AddJoint("left_hip", "hips", "left_hip");
  builder.AddJoint("right_hip", "hips", "right_hip");
  // The waist is a point on the belly, 19 degrees in front of the hips' vertical in every genre.
  builder.Add("waist", "hips", {{"waist", 1.0}}, {At("pelvis", 0, 0.037, 0.027)}, 0.5);
  builder.Add(
      "shoulders", "hips", {{"left_shoulder", 0.5}, {"right_shoulder", 0.5}},
      {{.joint = "left_shoulder", .weight = 0.5}, {.joint = "right_shoulder", .weight = 0.5}}, 1,
      false);
  builder.Add("head", "shoulders", {{"left_temple", 0.5}, {"right_temple", 0.5}},
              {At("head", 0, 0.06, -0.02)});
  for (const std::string side : {"left", "right"}) {
    const double out = Outwards(side);
    const auto named = [&side](const char* part) { return side + "_" + part; };
    builder.Add(named("temple"), "head", {{named("temple"), 1.0}},
                {At("head", out * 0.055, 0.06, -0.02)}, 0.5);
    builder.AddJoint(named("shoulder"), "shoulders", named("shoulder"));
    builder.AddJoint(named("elbow"), named("shoulder"), named("elbow"));
    builder.AddJoint(named("wrist"), named("elbow"), named("wrist"));
    builder.AddJoint(named("hand"), named("wrist"), named("hand"), 0.7);
    builder.AddJoint(named("knee"), named("hip"), named("knee"));
    // The source's ankle is the outer ankle bone, which is why its heel seems to stand inwards.
    builder.Add(named("ankle"), named("knee"), {{named("ankle"), 1.0}},
                {At(named("ankle"), out * 0.03, 0, 0)});
    builder.Add(named("heel"), named("ankle"), {{named("heel"), 1.0}},
                {At(named("ankle"), -out * 0.005, -0.05, -0.055)}, 0.5);
    builder.Add(named("toes"), named("ankle"), {{named("toes"), 1.0}}, {{.joint = named("foot")}});
    builder.mapping_.feet.push_back(named("toes"));
    builder.mapping_.feet.push_back(named("heel"));
  }
  return builder.mapping_;
}

namespace {

// Finds joints whatever their prefix ("mixamorig:Hips") and returns the name as the file has it.
class BvhNames {
 public:
  explicit BvhNames(const std::vector<std::string>& names) : names_(names) {}

  std::optional<std::string> Any(std::initializer_list<const char*> candidates) const {
    for (const std::string candidate : candidates) {
      for (const std::string& name : names_) {
        const bool prefixed =
            name.size() > candidate.size() && name.ends_with(candidate) &&
            std::string(":_").find(name[name.size() - candidate.size() - 1]) != std::string::npos;
        if (name == candidate || prefixed) return name;
      }
    }
    return std::nullopt;
  }
  std::string Need(std::initializer_list<const char*> candidates) const {
    if (const auto name = Any(candidates)) return *name;
    throw InvalidArgument("joint_names", "no joint named '" + std::string(*candidates.begin()) +
                                             "' or one of its usual other names");
  }

 private:
  const std::vector<std::string>& names_;
};

struct SideNames {
  std::string hip, knee, ankle, shoulder, elbow, wrist;
  std::optional<std::string> toes, hand, eye;
};

SideNames FindSide(const BvhNames& names, bool left) {
  SideNames side;
  side.hip = left ? names.Need({"LeftUpLeg", "LeftHip", "lThigh", "LeftThigh", "left_hip"})
                  : names.Need({"RightUpLeg", "RightHip", "rThigh", "RightThigh", "right_hip"});
  side.knee = left ? names.Need({"LeftLeg", "LeftKnee", "lShin", "LeftShin", "left_knee"})
                   : names.Need({"RightLeg", "RightKnee", "rShin", "RightShin", "right_knee"});
  side.ankle = left ? names.Need({"LeftFoot", "LeftAnkle", "lFoot", "left_ankle"})
                    : names.Need({"RightFoot", "RightAnkle", "rFoot", "right_ankle"});
  side.shoulder =
      left ? names.Need({"LeftArm", "lShldr", "LeftUpArm", "LeftUpperArm", "left_shoulder"})
           : names.Need({"RightArm", "rShldr", "RightUpArm", "RightUpperArm", "right_shoulder"});
  side.elbow =
      left ? names.Need({"LeftForeArm", "LeftElbow", "lForeArm", "LeftLowArm", "left_elbow"})
           : names.Need({"RightForeArm", "RightElbow", "rForeArm", "RightLowArm", "right_elbow"});
  side.wrist = left ? names.Need({"LeftHand", "LeftWrist", "lHand", "left_wrist"})
                    : names.Need({"RightHand", "RightWrist", "rHand", "right_wrist"});
  side.toes = left ? names.Any({"LeftToeBase", "LeftToe", "LeftToes", "lFoot_end", "LeftFoot_end",
                                "left_foot"})
                   : names.Any({"RightToeBase", "RightToe", "RightToes", "rFoot_end",
                                "RightFoot_end", "right_foot"});
  side.hand =
      left
          ? names.Any({"LeftHandMiddle1", "lMid1", "LeftHandIndex1", "LeftFingerBase", "left_hand"})
          : names.Any(
                {"RightHandMiddle1", "rMid1", "RightHandIndex1", "RightFingerBase", "right_hand"});
  side.eye = left ? names.Any({"leftEye", "LeftEye"}) : names.Any({"rightEye", "RightEye"});
  return side;
}

// What of the source stands where our spine3 stands: two thirds of the way from the hips to the
// neck.
std::optional<JointBlend> ChestBlend(const BvhNames& names, const std::string& neck) {
  const auto joint = [&names](const char* name) { return names.Any({name}); };
  if (joint("Spine4")) return JointBlend{{*joint("Spine2"), 0.325}, {*joint("Spine3"), 0.675}};
  if (joint("chest")) return JointBlend{{*joint("chest"), 0.8}, {neck, 0.2}};
  for (const char* name : {"Spine3", "Spine2", "Spine1"}) {
    if (joint(name)) return JointBlend{{*joint(name), 1.0}};
  }
  return std::nullopt;
}

}  // namespace

SourceMapping BvhSource(const std::vector<std::string>& joint_names) {
  const BvhNames names(joint_names);
  const SideNames sides[] = {FindSide(names, true), FindSide(names, false)};
  const std::string neck = names.Need({"Neck", "Neck1", "neck"});
  MappingBuilder builder("bvh");
  builder.Add("hips", "", {{sides[0].hip, 0.5}, {sides[1].hip, 0.5}},
              {{.joint = "left_hip", .weight = 0.5}, {.joint = "right_hip", .weight = 0.5}});
  builder.AddJoint("left_hip", "hips", sides[0].hip);
  builder.AddJoint("right_hip", "hips", sides[1].hip);
  // The first spine joint is fixed to the pelvis and stands straight above the hips.
  if (const auto spine = names.Any({"Spine", "abdomen", "Chest"})) {
    builder.Add("lumbar", "hips", {{*spine, 1.0}}, {At("pelvis", 0, 0.034, -0.012)}, 0.7);
  }
  if (const auto chest = ChestBlend(names, neck)) {
    builder.Add("chest", "hips", *chest, {{.joint = "spine3"}}, 0.5, false);
  }
  builder.Add("neck", "hips", {{neck, 1.0}}, {{.joint = "neck"}}, 1, false);
  if (const auto head = names.Any({"Head", "head"})) {
    // Straight above the neck, where ours leads forward.
    const bool eyes = sides[0].eye && sides[1].eye;
    builder.Add("head", "neck", {{*head, 1.0}}, {At("neck", 0, 0.09, 0.012)});
    if (eyes) {
      builder.Add("left_eye", "head", {{*sides[0].eye, 1.0}}, {At("head", 0.03, 0.07, 0.032)}, 0.5);
      builder.Add("right_eye", "head", {{*sides[1].eye, 1.0}}, {At("head", -0.03, 0.07, 0.032)},
                  0.5);
    }
  }
  for (const bool left : {true, false}) {
    const SideNames& side = sides[left ? 0 : 1];
    const std::string prefix = left ? "left_" : "right_";
    const double out = left ? 1 : -1;
    builder.AddJoint(prefix + "shoulder", "neck", side.shoulder);
    builder.AddJoint(prefix + "elbow", prefix + "shoulder", side.elbow);
    builder.AddJoint(prefix + "wrist", prefix + "elbow", side.wrist);
    if (side.hand) builder.AddJoint(prefix + "hand", prefix + "wrist", *side.hand, 0.7);
    builder.AddJoint(prefix + "knee", prefix + "hip", side.knee);
    builder.AddJoint(prefix + "ankle", prefix + "knee", side.ankle);
    builder.mapping_.feet.push_back(side.ankle);
    if (side.toes) {
      // Their ankles stand higher than ours, so that on a flat foot the toes lie 41 degrees below
      // them; end sites of feet lie 17 degrees below.
      const bool end_site = side.toes->ends_with("_end");
      builder.Add(prefix + "toes", prefix + "ankle", {{*side.toes, 1.0}},
                  {end_site ? At(prefix + "ankle", out * 0.02, -0.037, 0.12)
                            : At(prefix + "ankle", out * 0.02, -0.07, 0.08)});
      builder.mapping_.feet.push_back(*side.toes);
    }
  }
  return builder.mapping_;
}

}  // namespace choreo
