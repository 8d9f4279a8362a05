#include "model/fit/bones/character_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "model/core/error.h"
#include "model/core/joined.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo {
namespace {

constexpr double kMaxAnkleHeight =
    0.3;  // share of the leg: an ankle above this is not on a floor at y = 0
constexpr double kSunkenToes = -0.03;    // share of the leg: nor are toes below this
constexpr double kToesHeight = 0.025;    // share of the leg: height of SMPL's toes
constexpr double kAnkleHeight = 0.1;     // share of the leg: height of SMPL's ankles
constexpr double kMinBoneLength = 1e-4;  // share of the leg

class BodyBuilder {
 public:
  BodyBuilder(const HumanBones& bones, const Eigen::Matrix3Xd& places)
      : bones_(bones), places_(places), rest_(JointPositions(smpl_, RestPose(smpl_))) {}

  CharacterBody Build() {
    Upright();
    AddTrunk();
    for (const std::string side : {"left_", "right_"}) AddArm(side);
    for (const std::string side : {"left_", "right_"}) AddLeg(side);
    Skeleton& skeleton = body_.skeleton;
    skeleton.name = "character";
    skeleton.AssignRoles();
    Stand();
    skeleton.Check();
    return std::move(body_);
  }

 private:
  Eigen::Vector3d Place(const std::string& bone) const { return places_.col(bones_.Find(bone)); }
  Eigen::Vector3d Rest(const std::string& joint) const { return rest_.col(smpl_.Find(joint)); }

  // Turns the rig upright, facing +Z.
  void Upright() {
    const auto middle = [&](const std::string& joint) -> Eigen::Vector3d {
      return (Place("left_" + joint) + Place("right_" + joint)) / 2;
    };
    const auto across = [&](const std::string& joint) -> Eigen::Vector3d {
      return Place("left_" + joint) - Place("right_" + joint);
    };
    const Eigen::Vector3d trunk = middle("shoulder") - middle("hip");
    Eigen::Index axis = 0;
    trunk.cwiseAbs().maxCoeff(&axis);
    const Eigen::Vector3d up = Eigen::Vector3d::Unit(axis) * (trunk[axis] < 0 ? -1 : 1);
    Eigen::Vector3d left = across("shoulder") + across("hip");
    left -= left.dot(up) * up;
    leg_ = (Place("left_knee") - Place("left_hip")).norm() +
           (Place("left_ankle") - Place("left_knee")).norm();
    if (!(left.norm() > kMinBoneLength * leg_) || !(trunk.norm() > kMinBoneLength * leg_)) {
      throw InvalidArgument("bones", "hips and shoulders of left and right stand in one place");
    }
    left.normalize();
    upright_.row(0) = left;
    upright_.row(1) = up;
    upright_.row(2) = left.cross(up);
    double ahead = 0;
    for (const std::string side : {"left_", "right_"}) {
      if (HasToes(side)) ahead += (upright_ * (Place(side + "foot") - Place(side + "ankle"))).z();
    }
    if (ahead < 0) {
      throw InvalidArgument("bones", "the feet point backwards: left and right are exchanged");
    }
  }

  bool HasToes(const std::string& side) const {
    return bones_.Find(side + "foot") >= 0 &&
           (Place(side + "foot") - Place(side + "ankle")).norm() > kMinBoneLength * leg_;
  }

  int Add(const std::string& joint, int node, int parent, const Eigen::Vector3d& offset,
          const Eigen::Matrix3d& turn) {
    body_.nodes.push_back(node);
    body_.turns.push_back(turn);
    return body_.skeleton.AddJoint(joint, parent, offset);
  }

  int AddBone(const std::string& bone, int parent, const Eigen::Matrix3d& turn) {
    const int node = bones_.Find(bone);
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    if (parent >= 0) {
      offset = body_.turns[parent] * (places_.col(node) - places_.col(body_.nodes[parent]));
    }
    return Add(bone, node, parent, offset, turn);
  }

  void AddTrunk() {
    chest_ = AddBone("pelvis", -1, upright_);
    for (const std::string& bone : bones_.Spine()) chest_ = AddBone(bone, chest_, upright_);
    int neck = chest_;
    for (const std::string& bone : bones_.Neck()) neck = AddBone(bone, neck, upright_);
    if (bones_.Find("head") >= 0) AddBone("head", neck, upright_);
  }

  // The rotation from the rest pose, after `turn`, to the bone's direction in SMPL. It leads
  // through `straight`, near which SMPL's bones are, so that no bone rolls on the way.
  Eigen::Matrix3d Along(const std::string& from, const std::string& to, const Eigen::Matrix3d& turn,
                        const Eigen::Vector3d& straight) const {
    const Eigen::Vector3d bone = turn * (Place(to) - Place(from));
    if (!(bone.norm() > kMinBoneLength * leg_))
      throw InvalidArgument("bones", to + " stands where " + from + " does");
    const auto turning = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return Eigen::Quaterniond::FromTwoVectors(a, b).toRotationMatrix();
    };
    return turning(straight, Rest(to) - Rest(from)) * turning(bone, straight) * turn;
  }

  void AddArm(const std::string& side) {
    int above = chest_;
    if (bones_.Find(side + "collar") >= 0) above = AddBone(side + "collar", above, upright_);
    const Eigen::Vector3d out = Eigen::Vector3d::UnitX() * (side == "left_" ? 1 : -1);
    const Eigen::Matrix3d arm = Along(side + "shoulder", side + "elbow", upright_, out);
    const Eigen::Matrix3d forearm = Along(side + "elbow", side + "wrist", arm, out);
    above = AddBone(side + "shoulder", above, arm);
    above = AddBone(side + "elbow", above, forearm);
    AddBone(side + "wrist", above, forearm);  // a hand continues along the forearm
  }

  void AddLeg(const std::string& side) {
    const Eigen::Vector3d down = -Eigen::Vector3d::UnitY();
    const Eigen::Matrix3d thigh = Along(side + "hip", side + "knee", upright_, down);
    const Eigen::Matrix3d shin = Along(side + "knee", side + "ankle", thigh, down);
    int above = AddBone(side + "hip", 0, thigh);
    above = AddBone(side + "knee", above, shin);
    const Eigen::Vector3d ours = Rest(side + "foot") - Rest(side + "ankle");
    if (HasToes(side)) {
      const Eigen::Matrix3d foot =
          Flat(upright_ * (Place(side + "foot") - Place(side + "ankle")), ours);
      above = AddBone(side + "ankle", above, foot);
      AddBone(side + "foot", above, foot);
    } else {
      above = AddBone(side + "ankle", above, upright_);
      Eigen::Vector3d offset = ours * Size();
      offset.y() = kToesHeight * leg_ - AnkleHeight(side);
      Add(side + "foot", -1, above, offset, upright_);
    }
  }

  // A foot is flat at rest, so it turns about the vertical only.
  Eigen::Matrix3d Flat(const Eigen::Vector3d& foot, const Eigen::Vector3d& ours) const {
    if (std::hypot(foot.x(), foot.z()) < 0.5 * std::abs(foot.y())) return upright_;
    const double turn = std::atan2(ours.x(), ours.z()) - std::atan2(foot.x(), foot.z());
    return Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()).toRotationMatrix() * upright_;
  }

  double Height(const std::string& bone) const { return (upright_ * Place(bone)).y(); }

  // The rig's size relative to SMPL.
  double Size() const {
    return leg_ / ((Rest("left_knee") - Rest("left_hip")).norm() +
                   (Rest("left_ankle") - Rest("left_knee")).norm());
  }

  double Floor() const {
    const double ankle = std::min(Height("left_ankle"), Height("right_ankle"));
    double toes = ankle - (kAnkleHeight - kToesHeight) * leg_;
    bool stands = ankle > 0 && ankle < kMaxAnkleHeight * leg_;
    if (HasToes("left_") && HasToes("right_")) {
      toes = std::min(Height("left_foot"), Height("right_foot"));
      stands = stands && toes > kSunkenToes * leg_;
    }
    return stands ? 0 : toes - kToesHeight * leg_;
  }

  double AnkleHeight(const std::string& side) const { return Height(side + "ankle") - Floor(); }

  void Stand() {
    Skeleton& skeleton = body_.skeleton;
    for (const std::string side : {"left_", "right_"}) {
      double height = AnkleHeight(side);
      for (int joint = skeleton.Find(side + "ankle"); joint > 0; joint = skeleton.parents[joint])
        height -= skeleton.offsets(1, joint);
      skeleton.pelvis_height = std::max(skeleton.pelvis_height, height);
    }
  }

  const Skeleton& smpl_ = Skeleton::Smpl24();
  const HumanBones& bones_;
  const Eigen::Matrix3Xd& places_;
  const Eigen::Matrix3Xd rest_;
  CharacterBody body_;
  Eigen::Matrix3d upright_;
  double leg_ = 0;
  int chest_ = -1;
};

}  // namespace

std::string MissingBones(const HumanBones& bones) {
  constexpr size_t kNamed = 6;
  std::vector<std::string> missing;
  const auto look = [&](const std::string& bone) {
    if (bones.Find(bone) < 0) missing.push_back(bone);
  };
  look("pelvis");
  for (const std::string side : {"left_", "right_"}) {
    for (const char* bone : kNeededLimbBones) look(side + bone);
  }
  if (bones.Find("neck") < 0) look("head");
  if (missing.size() <= kNamed) return Joined(missing);
  const std::string more = " and " + std::to_string(missing.size() - kNamed) + " more";
  missing.resize(kNamed);
  return Joined(missing) + more;
}

CharacterBody MakeCharacterBody(const HumanBones& bones, const Eigen::Matrix3Xd& places) {
  if (const std::string missing = MissingBones(bones); !missing.empty())
    throw InvalidArgument("bones", "none of them is the " + missing);
  for (const auto& [name, chain] :
       {std::pair("spine", bones.Spine()), std::pair("neck", bones.Neck())}) {
    const auto has = std::ranges::count_if(
        bones.bones, [prefix = name](const auto& bone) { return bone.first.starts_with(prefix); });
    if (has != std::ssize(chain)) {
      throw InvalidArgument("bones", std::string("those of the ") + name +
                                         " are not numbered one after the other, from below");
    }
  }
  std::map<int, std::string> taken;
  for (const auto& [bone, node] : bones.bones) {
    const auto [other, is_new] = taken.try_emplace(node, bone);
    if (!is_new) throw InvalidArgument("bones", other->second + " and " + bone + " are one node");
  }
  return BodyBuilder(bones, places).Build();
}

}  // namespace choreo
