#include "model/training/prepare/recordings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/fit/solver/fit_clip.h"
#include "model/formats/bvh/bvh.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_clips.h"
#include "tests/training/preparation.h"

/// Made-up recordings in LAFAN1's layout.
namespace choreo::lafan1_test {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

/// Ours without hands, under LAFAN1's names.
Skeleton Lafan1Skeleton() {
  const Skeleton& smpl = Skeleton::Smpl24();
  static const std::pair<const char*, const char*> kNames[] = {{"Hips", "pelvis"},
                                                               {"LeftUpLeg", "left_hip"},
                                                               {"LeftLeg", "left_knee"},
                                                               {"Neck", "neck"},
                                                               {"LeftFoot", "left_ankle"},
                                                               {"LeftToe", "left_foot"},
                                                               {"Head", "head"},
                                                               {"RightUpLeg", "right_hip"},
                                                               {"RightLeg", "right_knee"},
                                                               {"Spine", "spine1"},
                                                               {"RightFoot", "right_ankle"},
                                                               {"RightToe", "right_foot"},
                                                               {"Spine1", "spine2"},
                                                               {"LeftShoulder", "left_collar"},
                                                               {"LeftArm", "left_shoulder"},
                                                               {"Spine2", "spine3"},
                                                               {"LeftForeArm", "left_elbow"},
                                                               {"LeftHand", "left_wrist"},
                                                               {"RightShoulder", "right_collar"},
                                                               {"RightArm", "right_shoulder"},
                                                               {"RightForeArm", "right_elbow"},
                                                               {"RightHand", "right_wrist"}};
  Skeleton skeleton;
  skeleton.name = "lafan1";
  skeleton.offsets.resize(3, 22);
  for (const std::string& name : Lafan1JointNames()) {
    const auto* ours =
        std::ranges::find_if(kNames, [&](const auto& pair) { return pair.first == name; })->second;
    const int joint = smpl.Find(ours);
    const int parent = smpl.parents[static_cast<size_t>(joint)];
    const auto* above = parent < 0
                            ? nullptr
                            : std::ranges::find_if(kNames, [&](const auto& pair) {
                                return pair.second == smpl.joint_names[static_cast<size_t>(parent)];
                              })->first;
    skeleton.offsets.col(skeleton.joints()) = smpl.offsets.col(joint);
    skeleton.parents.push_back(above == nullptr ? -1 : skeleton.Find(above));
    skeleton.joint_names.push_back(name);
  }
  skeleton.pelvis_height = smpl.pelvis_height;
  return skeleton;
}

/// The rotations of `motion`, of SMPL's skeleton, in that file: Z, Y, X Euler angles.
BvhFile Record(const Motion& motion) {
  const Skeleton& smpl = Skeleton::Smpl24();
  const Skeleton skeleton = Lafan1Skeleton();
  // Joints have another order there; joints with the same name have the same offset.
  std::vector<int> ours;
  for (int joint = 0; joint < skeleton.joints(); ++joint) {
    for (int other = 0; other < smpl.joints(); ++other) {
      if (skeleton.offsets.col(joint) == smpl.offsets.col(other)) ours.push_back(other);
    }
  }
  EXPECT_EQ(ours.size(), 22U);
  Motion renamed{motion.fps, {}};
  for (const Pose& pose : motion.frames) {
    Pose& out = renamed.frames.emplace_back();
    out.root_position = pose.root_position;
    out.rotations.resize(3, skeleton.joints());
    for (int joint = 0; joint < skeleton.joints(); ++joint)
      out.rotations.col(joint) = pose.rotations.col(ours[static_cast<size_t>(joint)]);
  }
  BvhFile file = MotionToBvh(skeleton, renamed);
  int row = 0;
  for (BvhJoint& joint : file.joints) {
    if (joint.channels.size() == 6) row += 3;
    if (joint.channels.empty()) continue;
    std::copy_n(
        std::vector{BvhChannel::kZRotation, BvhChannel::kYRotation, BvhChannel::kXRotation}.begin(),
        3, joint.channels.end() - 3);
    for (Eigen::Index f = 0; f < file.values.cols(); ++f) {
      const Pose& pose = renamed.frames[static_cast<size_t>(f)];
      file.values.block<3, 1>(row, f) =
          ExpMap(pose.rotations.col(skeleton.Find(joint.name))).eulerAngles(2, 1, 0) * 180 / M_PI;
    }
    row += 3;
  }
  return file;
}

class Lafan1Test : public Preparation {
 protected:
  Lafan1Test() : Preparation("lafan1") {}
  static Motion Walk() {
    Motion motion = testing_support::SyntheticClip("walk", 90, 0.3, false).motion;
    Ground(Skeleton::Smpl24(), motion);
    return motion;
  }
};

TEST_F(Lafan1Test, ConvertsARecordingWithThemeAndPart) {
  const BvhFile file = Record(Walk());
  for (const char* name : {"walk1_subject1", "run2_subject4", "dance1_subject5"})
    WriteBvh(In() / (std::string(name) + ".bvh"), file);
  WriteBvh(In() / "notes.bvh", file);  // no recording's name
  ASSERT_EQ(Prepare(options_), 3);

  const PreparedClip clip = Clip("walk1_subject1");
  EXPECT_EQ(clip.source, "lafan1");
  EXPECT_EQ(clip.notes.at("genre"), "walk");
  EXPECT_EQ(clip.motion.fps, 30);
  const Motion walk = Walk();
  ASSERT_EQ(clip.motion.frames.size(), walk.frames.size());
  const Skeleton& body = Skeleton::Smpl24();
  for (size_t f = 0; f < walk.frames.size(); f += 10) {
    const Eigen::Matrix3Xd here = JointPositions(body, clip.motion.frames[f]);
    const Eigen::Matrix3Xd there = JointPositions(body, walk.frames[f]);
    for (const char* joint : {"left_knee", "right_ankle", "left_elbow", "right_wrist"}) {
      EXPECT_LT((here.col(body.Find(joint)) - there.col(body.Find(joint))).norm(), 0.06)
          << joint << " in frame " << f;
    }
  }
  const json splits = Read("splits.json").at("lafan1");
  EXPECT_THAT(splits.at("train"), ElementsAre("walk1_subject1"));
  EXPECT_THAT(splits.at("validation"), ElementsAre("run2_subject4"));
  EXPECT_THAT(splits.at("test"), ElementsAre("dance1_subject5"));
}

TEST_F(Lafan1Test, AnotherSkeletonIsNamedAndSkipped) {
  WriteBvh(In() / "walk1_subject1.bvh", Record(Walk()));
  WriteBvh(In() / "walk1_subject2.bvh", MotionToBvh(Skeleton::Smpl24(), Walk()));
  BvhFile more = Record(Walk());
  for (BvhJoint& joint : more.joints) {
    if (joint.name == "Spine1") joint.name = "Spine3";
  }
  WriteBvh(In() / "walk1_subject3.bvh", more);
  ASSERT_EQ(Prepare(options_), 1);
  const json report = Read("report.json");
  EXPECT_THAT(report[1].at("skipped"), HasSubstr("has no joint Hips, which LAFAN1 has"));
  EXPECT_THAT(report[2].at("skipped"), HasSubstr("has no joint Spine1, which LAFAN1 has"));
}

TEST_F(Lafan1Test, AFolderWithoutRecordingsIsAnError) {
  WriteBvh(In() / "walk.bvh", Record(Walk()));
  ExpectError(ErrorCode::kNotFound, "no recording named as walk1_subject5.bvh",
              [&] { Prepare(options_); });
}

}  // namespace choreo::lafan1_test
