#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "model/core/error.h"
#include "model/fit/solver/fit_clip.h"
#include "model/fit/sources/sources.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/fit/fit_fixtures.h"

namespace choreo::bvh_source_test {

using fixtures::Dance;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

struct SourceJoint {
  const char* name;
  const char* parent;
  Eigen::Vector3d offset;
  const char* ours;  ///< whose rotation it takes, null for none
};

// A skeleton as in motion capture files: other proportions, five spine joints, collarbones near the
// neck, in centimetres.
std::vector<SourceJoint> MocapJoints() {
  std::vector<SourceJoint> joints = {
      {"Hips", nullptr, {0, 0, 0}, "pelvis"},     {"Spine", "Hips", {0, 7, 0}, nullptr},
      {"Spine1", "Spine", {0, 8, 0}, "spine1"},   {"Spine2", "Spine1", {0, 12, 0}, "spine2"},
      {"Spine3", "Spine2", {0, 15, 0}, "spine3"}, {"Spine4", "Spine3", {0, 11, 0}, nullptr},
      {"Neck", "Spine4", {0, 5, 0}, "neck"},      {"Head", "Neck", {0, 7, 0.9}, nullptr}};
  static const char* const kNames[2][8] = {
      {"LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase", "LeftShoulder", "LeftArm", "LeftForeArm",
       "LeftHand"},
      {"RightUpLeg", "RightLeg", "RightFoot", "RightToeBase", "RightShoulder", "RightArm",
       "RightForeArm", "RightHand"}};
  static const char* const kOurs[2][7] = {{"left_hip", "left_knee", "left_ankle", nullptr,
                                           "left_collar", "left_shoulder", "left_elbow"},
                                          {"right_hip", "right_knee", "right_ankle", nullptr,
                                           "right_collar", "right_shoulder", "right_elbow"}};
  for (int side = 0; side < 2; ++side) {
    const double out = side == 0 ? 1 : -1;
    const auto& name = kNames[side];
    const auto& ours = kOurs[side];
    joints.push_back({name[0], "Hips", {8.5 * out, -1, 0}, ours[0]});
    joints.push_back({name[1], name[0], {0, -43.5, 0}, ours[1]});
    joints.push_back({name[2], name[1], {0, -40.5, -1}, ours[2]});
    joints.push_back({name[3], name[2], {2 * out, -7, 10.5}, nullptr});
    joints.push_back({name[4], "Spine4", {4 * out, 2.4, 0}, ours[4]});
    joints.push_back({name[5], name[4], {14 * out, -3, 0}, ours[5]});
    joints.push_back({name[6], name[5], {28 * out, 0, -1}, ours[6]});
    joints.push_back({name[7], name[6], {25 * out, 0, 0}, nullptr});
  }
  return joints;
}

// The source's joints, in centimetres, when it dances `motion`.
PositionClip Perform(const std::vector<SourceJoint>& joints, const Motion& motion,
                     const std::string& prefix = "") {
  PositionClip clip;
  clip.fps = motion.fps;
  std::map<std::string, int> index;
  for (const SourceJoint& joint : joints) {
    index[joint.name] = static_cast<int>(clip.joint_names.size());
    clip.joint_names.push_back(prefix + joint.name);
  }
  for (const Pose& pose : motion.frames) {
    std::vector<Eigen::Matrix3d> turns;
    Eigen::Matrix3Xd positions(3, joints.size());
    for (const SourceJoint& joint : joints) {
      const Eigen::Matrix3d local = joint.ours == nullptr
                                        ? Eigen::Matrix3d::Identity()
                                        : ExpMap(pose.rotations.col(Smpl().Find(joint.ours)));
      const auto i = static_cast<Eigen::Index>(turns.size());
      if (joint.parent == nullptr) {
        positions.col(i) = 100 * pose.root_position;
        turns.push_back(local);
      } else {
        const int parent = index.at(joint.parent);
        positions.col(i) = positions.col(parent) + turns[parent] * joint.offset;
        turns.emplace_back(turns[parent] * local);
      }
    }
    clip.frames.push_back(positions);
  }
  return clip;
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

// Mean angle, degrees, between the directions of a bone of the fit and of the source.
double BoneError(const FitResult& fit, const PositionClip& source, const char* our_from,
                 const char* our_to, const char* from, const char* to) {
  double sum = 0;
  for (size_t frame = 0; frame < source.frames.size(); ++frame) {
    const Eigen::Matrix3Xd ours = JointPositions(Smpl(), fit.motion.frames[frame]);
    const Eigen::Matrix3Xd& theirs = source.frames[frame];
    sum += AngleBetween(ours.col(Smpl().Find(our_to)) - ours.col(Smpl().Find(our_from)),
                        theirs.col(IndexOf(source.joint_names, to)) -
                            theirs.col(IndexOf(source.joint_names, from)));
  }
  return sum / static_cast<double>(source.frames.size());
}

TEST(BvhSource, FollowsASkeletonOfAnotherBuild) {
  const Motion dance = Dance(240);
  const PositionClip source = Perform(MocapJoints(), dance);
  const FitResult fit = FitClip(source, BvhSource(source), Smpl());
  EXPECT_LT(fit.mean_error_m, 0.02);
  EXPECT_NEAR(fit.scale, 0.01, 0.001);
  EXPECT_LT(BoneError(fit, source, "left_hip", "left_knee", "LeftUpLeg", "LeftLeg"), 4);
  EXPECT_LT(BoneError(fit, source, "right_knee", "right_ankle", "RightLeg", "RightFoot"), 4);
  EXPECT_LT(BoneError(fit, source, "left_shoulder", "left_elbow", "LeftArm", "LeftForeArm"), 4);
  EXPECT_LT(BoneError(fit, source, "right_elbow", "right_wrist", "RightForeArm", "RightHand"), 4);
  // Positions determine only in combination where pelvis, chest and feet face.
  double pelvis = 0, chest = 0, foot = 0;
  for (size_t frame = 0; frame < dance.frames.size(); ++frame) {
    const JointPlacement ours = ForwardKinematics(Smpl(), fit.motion.frames[frame]);
    const JointPlacement theirs = ForwardKinematics(Smpl(), dance.frames[frame]);
    const auto angle = [&](const char* joint) {
      const int i = Smpl().Find(joint);
      return LogMap(ours.rotations[i].transpose() * theirs.rotations[i]).norm() * 180 /
             std::numbers::pi / static_cast<double>(dance.frames.size());
    };
    pelvis += angle("pelvis");
    chest += angle("spine3");
    foot += angle("left_ankle");
  }
  EXPECT_LT(pelvis, 8);
  EXPECT_LT(chest, 12);
  EXPECT_LT(foot, 15);
}

// The same dancer under other names; joints not in `names` get meaningless names.
PositionClip Renamed(PositionClip clip, const std::map<std::string, std::string>& names) {
  for (std::string& name : clip.joint_names) {
    const auto found = names.find(name);
    name = found == names.end() ? "other_" + std::to_string(&name - clip.joint_names.data())
                                : found->second;
  }
  return clip;
}

TEST(BvhSource, KnowsPrefixesAndOtherNames) {
  const PositionClip source = Perform(MocapJoints(), Dance(5));
  std::map<std::string, std::string> poser = {{"Hips", "hip"},
                                              {"Spine1", "abdomen"},
                                              {"Spine3", "chest"},
                                              {"Neck", "neck"},
                                              {"Head", "head"}};
  std::map<std::string, std::string> biped = {{"Hips", "Hips"},
                                              {"Spine1", "Chest"},
                                              {"Spine3", "Chest2"},
                                              {"Neck", "Neck"},
                                              {"Head", "Head"}};
  std::map<std::string, std::string> iclone = {{"Hips", "CC_Base_Hip"},
                                               {"Spine1", "CC_Base_Waist"},
                                               {"Spine3", "CC_Base_Spine02"},
                                               {"Neck", "CC_Base_NeckTwist01"},
                                               {"Head", "CC_Base_Head"}};
  for (const std::string side : {"Left", "Right"}) {
    const std::string initial(1, side[0]), small(1, side == "Left" ? 'l' : 'r');
    const auto add = [&](const char* name, const char* in_poser, const char* in_biped,
                         const char* in_iclone) {
      poser[side + name] = small + in_poser;
      biped[side + name] = side + in_biped;
      iclone[side + name] = "CC_Base_" + initial + "_" + in_iclone;
    };
    add("UpLeg", "Thigh", "Hip", "Thigh");
    add("Leg", "Shin", "Knee", "Calf");
    add("Foot", "Foot", "Ankle", "Foot");
    add("ToeBase", "Foot_end", "Toe", "ToeBase");
    add("Shoulder", "Collar", "Collar", "Clavicle");
    add("Arm", "Shldr", "Shoulder", "Upperarm");
    add("ForeArm", "ForeArm", "Elbow", "Forearm");
    add("Hand", "Hand", "Wrist", "Hand");
  }
  for (const auto& names : {poser, biped, iclone}) {
    const PositionClip renamed = Renamed(source, names);
    const FitResult fit = FitClip(renamed, BvhSource(renamed), Smpl());
    EXPECT_LT(fit.mean_error_m, 0.02);
    // Collarbones and shoulders are distinguished.
    const auto from = names.at("LeftArm"), to = names.at("LeftForeArm");
    EXPECT_LT(BoneError(fit, renamed, "left_shoulder", "left_elbow", from.c_str(), to.c_str()), 6);
  }
  const PositionClip prefixed = Perform(MocapJoints(), Dance(5), "mixamorig:");
  EXPECT_LT(FitClip(prefixed, BvhSource(prefixed), Smpl()).mean_error_m, 0.02);
}

TEST(BvhSource, NamesTheJointThatIsMissing) {
  PositionClip source = Perform(MocapJoints(), Dance(2));
  *std::ranges::find(source.joint_names, "RightLeg") = "x";
  try {
    BvhSource(source);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("RightLeg"), std::string::npos);
  }
}

}  // namespace choreo::bvh_source_test
