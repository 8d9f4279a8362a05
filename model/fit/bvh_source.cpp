#include "model/fit/bvh_source.h"

#include <cmath>
#include <optional>

#include "model/core/error.h"
#include "model/core/quantile.h"
#include "model/fit/human_bones.h"
#include "model/fit/mapping_builder.h"

namespace choreo {
namespace {

/// The clip's joints by what they are.
class ClipBones {
 public:
  explicit ClipBones(const PositionClip& clip)
      : names_(clip.joint_names), found_(FindHumanBones(clip.joint_names)) {}

  std::optional<std::string> Any(const std::string& bone) const {
    const int index = found_.Find(bone);
    if (index < 0) return std::nullopt;
    return names_[static_cast<size_t>(index)];
  }
  std::string Need(const std::string& bone) const {
    if (const auto name = Any(bone)) return *name;
    throw InvalidArgument("joint_names", "no joint named '" + NameInRig(found_.rig, bone) +
                                             "' or one of its usual other names (" + bone + ")");
  }
  std::vector<std::string> Spine() const {
    std::vector<std::string> spine;
    for (const int index : found_.Spine()) spine.push_back(names_[static_cast<size_t>(index)]);
    return spine;
  }

 private:
  const std::vector<std::string>& names_;
  HumanBones found_;
};

struct SideNames {
  std::string hip, knee, ankle, shoulder, elbow, wrist;
  std::optional<std::string> toes, hand, eye, collar;
};

SideNames FindSide(const ClipBones& bones, const std::string& side) {
  return {.hip = bones.Need(side + "hip"),
          .knee = bones.Need(side + "knee"),
          .ankle = bones.Need(side + "ankle"),
          .shoulder = bones.Need(side + "shoulder"),
          .elbow = bones.Need(side + "elbow"),
          .wrist = bones.Need(side + "wrist"),
          .toes = bones.Any(side + "foot"),
          .hand = bones.Any(side + "hand"),
          .eye = bones.Any(side + "eye"),
          .collar = bones.Any(side + "collar")};
}

double MedianDistance(const PositionClip& clip, const JointBlend& a, const JointBlend& b) {
  const auto point = [&clip](const JointBlend& blend, const Eigen::Matrix3Xd& frame) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [name, weight] : blend) sum += weight * frame.col(FindJoint(clip, name));
    return sum;
  };
  std::vector<double> distances;
  for (const Eigen::Matrix3Xd& frame : clip.frames) {
    distances.push_back((point(a, frame) - point(b, frame)).norm());
  }
  return Median(std::move(distances));
}

JointBlend Scaled(JointBlend blend, double factor) {
  for (auto& [name, weight] : blend) weight *= factor;
  return blend;
}

JointBlend Sum(JointBlend a, const JointBlend& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// The spine from the middle of the hips to the neck, whatever number of joints it has.
class SpineChain {
 public:
  SpineChain(const PositionClip& clip, const ClipBones& bones, const JointBlend& hips,
             const std::string& neck)
      : points_{hips}, heights_{0.0} {
    const auto append = [&](const JointBlend& point) {
      const double step = MedianDistance(clip, points_.back(), point);
      // Some files start the spine with joints that stand in the hips.
      if (step < 1e-3) return;
      heights_.push_back(heights_.back() + step);
      points_.push_back(point);
    };
    for (const std::string& joint : bones.Spine()) append({{joint, 1.0}});
    append({{neck, 1.0}});
  }

  double length() const { return heights_.back(); }
  bool has_joints() const { return points_.size() > 2; }
  const JointBlend& first_joint() const { return points_[1]; }

  /// The point at a fraction of the way up.
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

// Where our joints stand at rest, as fractions of the way from the hips to the neck.
constexpr double kChestHeight = 0.657;
constexpr double kCollarHeight = 0.841;
constexpr double kHalfCollarWidth = 0.1254;
// A shoulder with the arm held out sideways, seen from the collar.
constexpr double kShoulderOut = 0.207;
constexpr double kShoulderUp = 0.035;
// How much of the source's movement of the shoulders ours keep.
constexpr double kShoulderShare = 0.4;

// Source skeletons hang their collarbones higher and nearer to the neck than ours, and swing them
// much further: seen from where our collarbone turns, an arm that hangs down would draw the
// shoulder right through it. So the shoulder is taken as a blend of the source's and of a place
// fixed to the chest.
void AddCollar(const PositionClip& clip, const SpineChain& spine, const SideNames& left,
               const SideNames& right, bool is_left, MappingBuilder& builder) {
  const SideNames& side = is_left ? left : right;
  const SideNames& other = is_left ? right : left;
  // Across the chest, outwards on this side.
  const std::string& inner = side.collar && other.collar ? *side.collar : side.shoulder;
  const std::string& outer = side.collar && other.collar ? *other.collar : other.shoulder;
  const double width = MedianDistance(clip, {{inner, 1.0}}, {{outer, 1.0}});
  const double unit = width > 1e-6 ? spine.length() / width : 0.0;
  const JointBlend across = Scaled({{inner, 1.0}, {outer, -1.0}}, unit);
  const JointBlend collar = Sum(spine.At(kCollarHeight), Scaled(across, kHalfCollarWidth));
  const JointBlend up = Sum(spine.At(1.0), Scaled(spine.At(1.0 - kShoulderUp), -1.0));
  const JointBlend held_out = Sum(collar, Sum(Scaled(across, kShoulderOut), up));
  const JointBlend shoulder =
      Sum(Scaled({{side.shoulder, 1.0}}, kShoulderShare), Scaled(held_out, 1.0 - kShoulderShare));
  const std::string prefix = is_left ? "left_" : "right_";
  builder.Add(prefix + "collar", "neck", collar, {{.joint = prefix + "collar"}}, 0.7);
  builder.Add(prefix + "shoulder", prefix + "collar", shoulder, {{.joint = prefix + "shoulder"}});
}

void AddTrunk(const PositionClip& clip, const ClipBones& bones, const SideNames& left,
              const SideNames& right, MappingBuilder& builder) {
  const std::string neck = bones.Need("neck");
  const JointBlend hips = {{left.hip, 0.5}, {right.hip, 0.5}};
  const SpineChain spine(clip, bones, hips, neck);
  builder.Add("hips", "", hips, MappingBuilder::Between("left_hip", "right_hip"));
  builder.AddJoint("left_hip", "hips", left.hip);
  builder.AddJoint("right_hip", "hips", right.hip);
  if (spine.has_joints()) {
    // The first spine joint is fixed to the pelvis and stands straight above the hips.
    builder.Add("lumbar", "hips", spine.first_joint(),
                {MappingBuilder::At("pelvis", 0, 0.034, -0.012)}, 0.7);
    builder.Add("chest", "hips", spine.At(kChestHeight), {{.joint = "spine3"}}, 0.5, false);
  }
  builder.Add("neck", "hips", {{neck, 1.0}}, {{.joint = "neck"}}, 1, false);
  if (const auto head = bones.Any("head")) {
    // Straight above the neck, where ours leads forward.
    builder.Add("head", "neck", {{*head, 1.0}}, {MappingBuilder::At("neck", 0, 0.09, 0.012)});
    if (left.eye && right.eye) {
      builder.Add("left_eye", "head", {{*left.eye, 1.0}},
                  {MappingBuilder::At("head", 0.03, 0.07, 0.032)}, 0.5);
      builder.Add("right_eye", "head", {{*right.eye, 1.0}},
                  {MappingBuilder::At("head", -0.03, 0.07, 0.032)}, 0.5);
    }
  }
  AddCollar(clip, spine, left, right, true, builder);
  AddCollar(clip, spine, left, right, false, builder);
}

// Where a toe joint stands on a flat foot, forward of the ankle and up: 33 degrees below it
// (dancedb's median), where ours lies 26; end sites of feet lie 17 degrees below, iClone's toes 5.
Eigen::Vector2d ToePoint(const std::string& toes) {
  if (toes.ends_with("_end")) return {0.12, -0.037};
  if (toes.ends_with("L_ToeBase") || toes.ends_with("R_ToeBase")) return {0.12, -0.011};
  return {0.082, -0.055};
}

void AddLimbs(const SideNames& side, bool left, MappingBuilder& builder) {
  const std::string prefix = left ? "left_" : "right_";
  const double out = left ? 1 : -1;
  builder.AddJoint(prefix + "elbow", prefix + "shoulder", side.elbow);
  builder.AddJoint(prefix + "wrist", prefix + "elbow", side.wrist);
  if (side.hand) builder.AddJoint(prefix + "hand", prefix + "wrist", *side.hand, 0.7);
  builder.AddJoint(prefix + "knee", prefix + "hip", side.knee);
  builder.AddJoint(prefix + "ankle", prefix + "knee", side.ankle);
  builder.AddFoot(side.ankle);
  if (!side.toes) return;
  const Eigen::Vector2d point = ToePoint(*side.toes);
  builder.Add(prefix + "toes", prefix + "ankle", {{*side.toes, 1.0}},
              {MappingBuilder::At(prefix + "ankle", out * 0.02, point.y(), point.x())});
  builder.AddFoot(*side.toes);
}

}  // namespace

SourceMapping BvhSource(const PositionClip& clip) {
  ValidateClip(clip);
  const ClipBones bones(clip);
  const SideNames left = FindSide(bones, "left_");
  const SideNames right = FindSide(bones, "right_");
  MappingBuilder builder("bvh", 0.01);
  AddTrunk(clip, bones, left, right, builder);
  AddLimbs(left, true, builder);
  AddLimbs(right, false, builder);
  return builder.Take();
}

}  // namespace choreo
