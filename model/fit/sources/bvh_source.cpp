#include <cmath>
#include <optional>
#include <utility>

#include "model/core/error.h"
#include "model/fit/bones/human_bones.h"
#include "model/fit/sources/mapping_builder.h"
#include "model/fit/sources/sources.h"
#include "model/motion/kinematics/mirror.h"

namespace choreo {
namespace {

/// The clip's joints by bone.
class ClipBones {
 public:
  ClipBones(const PositionClip& clip, HumanBones found)
      : names_(clip.joint_names), found_(std::move(found)) {}

  std::optional<std::string> Any(const std::string& bone) const {
    const int index = found_.Find(bone);
    if (index < 0) return std::nullopt;
    return names_[index];
  }
  std::string Need(const std::string& bone) const {
    if (const auto name = Any(bone)) return *name;
    throw InvalidArgument("joint_names", "no joint named '" + NameInRig(found_.rig, bone) +
                                             "' or one of its usual other names (" + bone + ")");
  }
  std::vector<std::string> Spine() const { return found_.Spine(); }

 private:
  const std::vector<std::string>& names_;
  HumanBones found_;
};

JointBlend Scaled(JointBlend blend, double factor) {
  for (auto& [name, weight] : blend) weight *= factor;
  return blend;
}

JointBlend Sum(JointBlend a, const JointBlend& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// The spine from the middle of the hips to the neck, with any number of joints.
class SpineChain {
 public:
  SpineChain(const PositionClip& clip, const ClipBones& bones, const JointBlend& hips,
             const std::string& neck)
      : points_{hips}, heights_{0.0} {
    const auto append = [&](const JointBlend& point) {
      const double step = MedianDistance(clip, points_.back(), point);
      // Some files start the spine with joints at the hips.
      if (step < 1e-3) return;
      heights_.push_back(heights_.back() + step);
      points_.push_back(point);
    };
    for (const std::string& bone : bones.Spine()) append({{bones.Need(bone), 1.0}});
    append({{neck, 1.0}});
  }

  double length() const { return heights_.back(); }
  bool has_joints() const { return points_.size() > 2; }
  const JointBlend& first_joint() const { return points_[1]; }

  /// The point at this fraction of the way up.
  JointBlend At(double fraction) const {
    size_t above = 1;
    while (above + 1 < points_.size() && heights_[above] < fraction * length()) ++above;
    const double t =
        (fraction * length() - heights_[above - 1]) / (heights_[above] - heights_[above - 1]);
    return Sum(Scaled(points_[above - 1], 1 - t), Scaled(points_[above], t));
  }

 private:
  std::vector<JointBlend> points_;
  std::vector<double> heights_;
};

// Rest positions of our joints, as fractions of the way from hips to neck.
constexpr double kChestHeight = 0.657;
constexpr double kCollarHeight = 0.841;
constexpr double kHalfCollarWidth = 0.1254;
// Position of the shoulder relative to the collar, with the arm held out sideways, metres.
constexpr double kShoulderOut = 0.207;
constexpr double kShoulderUp = 0.035;
// The share of the source's shoulder movement that ours keep.
constexpr double kShoulderShare = 0.4;

// Source skeletons have their collarbones higher and nearer to the neck than ours, and swing them
// much further. About our collar joint, a hanging arm would pull the shoulder through the collar.
// So the shoulder is a blend of the source's and a point fixed to the chest.
void AddCollar(const PositionClip& clip, const SpineChain& spine, const ClipBones& bones,
               const std::string& side, MappingBuilder& builder) {
  // The direction across the chest, outwards on this side.
  const bool collars = bones.Any("left_collar") && bones.Any("right_collar");
  const char* joint = collars ? "collar" : "shoulder";
  const std::string inner = bones.Need(side + joint), outer = bones.Need(OtherSide(side) + joint);
  const double width = MedianDistance(clip, {{inner, 1.0}}, {{outer, 1.0}});
  const double unit = width > 1e-6 ? spine.length() / width : 0.0;
  const JointBlend across = Scaled({{inner, 1.0}, {outer, -1.0}}, unit);
  const JointBlend collar = Sum(spine.At(kCollarHeight), Scaled(across, kHalfCollarWidth));
  const JointBlend up = Sum(spine.At(1.0), Scaled(spine.At(1.0 - kShoulderUp), -1.0));
  const JointBlend held_out = Sum(collar, Sum(Scaled(across, kShoulderOut), up));
  const JointBlend shoulder = Sum(Scaled({{bones.Need(side + "shoulder"), 1.0}}, kShoulderShare),
                                  Scaled(held_out, 1.0 - kShoulderShare));
  builder.Add(side + "collar", "neck", collar, {{.joint = side + "collar"}}, 0.7);
  builder.Add(side + "shoulder", side + "collar", shoulder, {{.joint = side + "shoulder"}});
}

void AddTrunk(const PositionClip& clip, const ClipBones& bones, MappingBuilder& builder) {
  const std::string neck = bones.Need("neck");
  const std::string left_hip = bones.Need("left_hip"), right_hip = bones.Need("right_hip");
  const SpineChain spine(clip, bones, {{left_hip, 0.5}, {right_hip, 0.5}}, neck);
  builder.AddHips(left_hip, right_hip);
  if (spine.has_joints()) {
    // The first spine joint is fixed to the pelvis, straight above the hips.
    builder.Add("lumbar", "hips", spine.first_joint(),
                {MappingBuilder::At("pelvis", 0, 0.034, -0.012)}, 0.7);
    builder.Add("chest", "hips", spine.At(kChestHeight), {{.joint = "spine3"}}, 0.5, false);
  }
  builder.Add("neck", "hips", {{neck, 1.0}}, {{.joint = "neck"}}, 1, false);
  if (const auto head = bones.Any("head")) {
    // The head is straight above the neck; ours leans forward.
    builder.Add("head", "neck", {{*head, 1.0}}, {MappingBuilder::At("neck", 0, 0.09, 0.012)});
    const auto left_eye = bones.Any("left_eye"), right_eye = bones.Any("right_eye");
    if (left_eye && right_eye) {
      builder.Add("left_eye", "head", {{*left_eye, 1.0}},
                  {MappingBuilder::At("head", 0.03, 0.07, 0.032)}, 0.5);
      builder.Add("right_eye", "head", {{*right_eye, 1.0}},
                  {MappingBuilder::At("head", -0.03, 0.07, 0.032)}, 0.5);
    }
  }
  AddCollar(clip, spine, bones, "left_", builder);
  AddCollar(clip, spine, bones, "right_", builder);
}

// Position of a toe joint on a flat foot, forward and up from the ankle, metres. It is 33 degrees
// below the ankle in most rigs (dancedb's median; 26 in ours), 17 for end sites of feet, and 5 for
// iClone's toes.
Eigen::Vector2d ToePoint(const std::string& toes) {
  if (toes.ends_with("_end")) return {0.12, -0.037};
  if (toes.ends_with("L_ToeBase") || toes.ends_with("R_ToeBase")) return {0.12, -0.011};
  return {0.082, -0.055};
}

void AddLimbs(const ClipBones& bones, const std::string& side, MappingBuilder& builder) {
  const auto add = [&](const std::string& joint, const std::string& parent) {
    builder.AddJoint(side + joint, side + parent, bones.Need(side + joint));
  };
  add("elbow", "shoulder");
  add("wrist", "elbow");
  if (const auto hand = bones.Any(side + "hand"))
    builder.AddJoint(side + "hand", side + "wrist", *hand, 0.7);
  add("knee", "hip");
  add("ankle", "knee");
  builder.AddFoot(bones.Need(side + "ankle"));
  const auto toes = bones.Any(side + "foot");
  if (!toes) return;
  const Eigen::Vector2d point = ToePoint(*toes);
  const double out = side == "left_" ? 1 : -1;
  builder.Add(side + "toes", side + "ankle", {{*toes, 1.0}},
              {MappingBuilder::At(side + "ankle", out * 0.02, point.y(), point.x())});
  builder.AddFoot(*toes);
}

}  // namespace

SourceMapping BvhSource(const PositionClip& clip) {
  return RigSource(clip, FindHumanBones(clip.joint_names));
}

SourceMapping RigSource(const PositionClip& clip, const HumanBones& found) {
  CheckClip(clip);
  const ClipBones bones(clip, found);
  for (const std::string side : {"left_", "right_"}) {
    for (const char* bone : kNeededLimbBones) bones.Need(side + bone);
  }
  MappingBuilder builder("bvh", 0.01);
  AddTrunk(clip, bones, builder);
  AddLimbs(bones, "left_", builder);
  AddLimbs(bones, "right_", builder);
  return builder.Take();
}

}  // namespace choreo
