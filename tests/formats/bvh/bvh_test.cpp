#include "model/formats/bvh/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"
#include "tests/motion/motion_fixtures.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::bvh_test {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

const Skeleton& kSmpl = Skeleton::Smpl24();

// Two bones, a channel order of its own each, a joint that slides, names with spaces, and Windows
// line ends.
constexpr const char* kArm =
    "HIERARCHY\r\n"
    "ROOT my hips\r\n"
    "{\r\n"
    "\tOFFSET 1 2 3\r\n"
    "\tCHANNELS 6 Yposition Xposition Zposition Zrotation Yrotation Xrotation\r\n"
    "\tJOINT Slide\r\n"
    "\t{\r\n"
    "\t\tOFFSET 0 10 0\r\n"
    "\t\tCHANNELS 4 Xposition Xrotation Yrotation Zrotation\r\n"
    "\t\tEnd Site\r\n"
    "\t\t{\r\n"
    "\t\t\tOFFSET 5 0 0\r\n"
    "\t\t}\r\n"
    "\t}\r\n"
    "}\r\n"
    "MOTION\r\n"
    "Frames: 2\r\n"
    "Frame Time: 0.0333333\r\n"
    "0 0 0 0 0 0 0 0 0 0\r\n"
    "20 10 30 90 0 90 7 0 0 -90\r\n";

TEST(Bvh, PlacesJointsInClosedForm) {
  const BvhFile file = ParseBvh(kArm, "arm");
  EXPECT_EQ(file.JointNames(), (std::vector<std::string>{"my hips", "Slide", "Slide_end"}));
  EXPECT_EQ(file.fps(), 30);
  ASSERT_EQ(file.frames(), 2);
  Eigen::Matrix3Xd expected(3, 3);
  // Position channels replace the offsets; the rest is the rest pose.
  expected << 0, 0, 5, 0, 10, 10, 0, 0, 0;
  EXPECT_LT((BvhPositions(file, 0) - expected).norm(), 1e-12);
  // The root: Rz(90) Rx(90) takes x to y, y to z, z to x. Slide stands at (7, 10, 0) and turns its
  // own x to -y.
  expected << 10, 10, 10, 20, 27, 27, 30, 40, 35;
  EXPECT_LT((BvhPositions(file, 1) - expected).norm(), 1e-12);
  const PositionClip clip = BvhToPositions(file, 0.01);
  EXPECT_LT((clip.frames[1] - 0.01 * expected).norm(), 1e-12);
}

TEST(Bvh, FrameTimesAreRoundingsOfRates) {
  const auto fps = [](double frame_time) {
    BvhFile file;
    file.frame_time = frame_time;
    return file.fps();
  };
  EXPECT_EQ(fps(0.0333333), 30);
  EXPECT_EQ(fps(0.00833333), 120);
  EXPECT_EQ(fps(0.04), 25);
  EXPECT_NEAR(fps(0.0333667), 30 / 1.001, 1e-9);
  EXPECT_NEAR(fps(1 / 12.34), 12.34, 1e-9);
}

TEST(Bvh, RoundTripsOnForwardKinematics) {
  const Motion motion = fixtures::SmoothMotion(kSmpl, 11, 50, 60);
  const BvhFile file = ParseBvh(BvhText(MotionToBvh(kSmpl, motion)), "ours");
  const Motion back = BvhToMotion(file, kSmpl).value();
  EXPECT_EQ(back.fps, 60);
  ASSERT_EQ(back.frames.size(), motion.frames.size());
  for (size_t i = 0; i < motion.frames.size(); ++i) {
    const PoseError error = ComparePoses(kSmpl, motion.frames[i], back.frames[i]);
    EXPECT_LT(error.position_m, 1e-6);
    EXPECT_LT(error.angle_deg, 1e-5);
    const Eigen::Matrix3Xd ours = JointPositions(kSmpl, motion.frames[i]);
    const Eigen::Matrix3Xd theirs = BvhPositions(file, static_cast<int64_t>(i));
    for (size_t joint = 0; joint < file.joints.size(); ++joint) {
      if (file.joints[joint].end_site) continue;
      const int index = kSmpl.Find(file.joints[joint].name);
      EXPECT_LT((ours.col(index) - 0.01 * theirs.col(joint)).norm(), 1e-6);
    }
  }
}

TEST(Bvh, RoundTripsInEveryLayout) {
  const Motion motion = fixtures::SmoothMotion(kSmpl, 12, 20, 30);
  for (const auto& [names, foot] :
       {std::pair(JointNames::kSmpl, "left_ankle"),
        std::pair(JointNames::kMixamo, "mixamorig:LeftFoot"),
        std::pair(JointNames::kHumanIk, "LeftFoot"), std::pair(JointNames::kUnreal, "foot_l")}) {
    for (const double units : {kCentimetres, kMetres}) {
      SCOPED_TRACE(foot);
      const BvhFile file = ParseBvh(BvhText(MotionToBvh(kSmpl, motion, {names, units})), "ours");
      const std::vector<std::string> called = file.JointNames();
      EXPECT_EQ(std::ranges::count(called, foot), 1);
      // At rest the hips are as high as they are.
      EXPECT_LT((file.joints[0].offset - units * Vector3d(0, kSmpl.pelvis_height, 0)).norm(), 1e-6);
      const Motion back = BvhToMotion(file, kSmpl).value();
      ASSERT_EQ(back.frames.size(), motion.frames.size());
      for (size_t i = 0; i < motion.frames.size(); ++i) {
        const PoseError error = ComparePoses(kSmpl, motion.frames[i], back.frames[i]);
        EXPECT_LT(error.position_m, 1e-5);
        EXPECT_LT(error.angle_deg, 1e-4);
      }
    }
  }
}

TEST(Bvh, KnowsOtherNamesOfSmplsJointsAlone) {
  std::set<std::string> names;
  for (const std::string& joint : kSmpl.joint_names) {
    for (const JointNames other : kAllJointNames) {
      if (other == JointNames::kSmpl) continue;
      const std::string name = JointName(joint, other);
      EXPECT_TRUE(joint == "pelvis" || joint == "head" || name != joint) << joint;
      EXPECT_TRUE(names.insert(std::string(NameOf(other)) + name).second) << name;
    }
  }
  for (const JointNames known : kAllJointNames)
    EXPECT_EQ(ParseJointNames(NameOf(known), "--names"), known);
  ExpectError(ErrorCode::kInvalidArgument, "--names: \"maya\" is none of smpl, mixamo, humanik, ue",
              [] { ParseJointNames("maya", "--names"); });
  Skeleton other = kSmpl;
  other.joint_names[3] = "waist";
  ExpectError(ErrorCode::kInvalidArgument, "names: mixamo has names for SMPL's joints alone", [&] {
    MotionToBvh(other, {.fps = 30, .frames = {RestPose(other)}}, {.names = JointNames::kMixamo});
  });
}

TEST(Bvh, EulerAnglesAreContinuousThroughGimbalLock) {
  // A joint whose middle angle (x) passes 90 degrees, and one that makes whole turns.
  Motion motion;
  for (int frame = 0; frame <= 120; ++frame) {
    Pose pose = RestPose(kSmpl);
    pose.rotations(0, kSmpl.left_shoulder) = frame * M_PI / 90;
    pose.rotations(1, kSmpl.right_shoulder) = frame * M_PI / 20;
    motion.frames.push_back(pose);
  }
  const BvhFile file = MotionToBvh(kSmpl, motion);
  double largest = 0;
  for (int64_t frame = 1; frame < file.frames(); ++frame) {
    largest = std::max(largest,
                       (file.values.col(frame) - file.values.col(frame - 1)).cwiseAbs().maxCoeff());
  }
  EXPECT_NEAR(largest, 9, 1e-6);
  const Motion back = BvhToMotion(file, kSmpl).value();
  for (size_t i = 0; i < motion.frames.size(); ++i) {
    EXPECT_LT(ComparePoses(kSmpl, motion.frames[i], back.frames[i]).angle_deg, 1e-6);
  }
}

// Knees bend past a quarter turn, a little to one side or the other: angles wound up there, so the
// end of a dance had others after a change in its middle.
TEST(Bvh, EulerAnglesDoNotWindUp) {
  const auto dance = [](double side) {
    Motion motion;
    for (int frame = 0; frame <= 300; ++frame) {
      Pose pose = RestPose(kSmpl);
      const double bend = 1 + std::sin(frame * M_PI / 15);  // 0 to 115 degrees
      const double aside = frame < 100 || frame > 200 ? 0.1 : side;
      pose.rotations.col(kSmpl.left_knee) << bend, 0.03, aside * std::sin(frame * M_PI / 40);
      motion.frames.push_back(pose);
    }
    return MotionToBvh(kSmpl, motion).values;
  };
  const Eigen::MatrixXd one = dance(0.1), other = dance(-0.3);
  EXPECT_LT(one.cwiseAbs().maxCoeff(), 200);
  EXPECT_LT(other.cwiseAbs().maxCoeff(), 200);
  EXPECT_LT((one - other).rightCols(80).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Bvh, AFileMayBeginWithABentKnee) {
  Pose pose = RestPose(kSmpl);
  pose.rotations.col(kSmpl.left_knee) << 2.1, 0.01, 0.02;
  const BvhFile file = MotionToBvh(kSmpl, {.fps = 30, .frames = {pose, pose}});
  EXPECT_LT(file.values.bottomRows(file.values.rows() - 3).cwiseAbs().maxCoeff(), 125);
}

TEST(Bvh, KnowsOurSkeletonFromOthers) {
  BvhFile file = MotionToBvh(kSmpl, fixtures::SmoothMotion(kSmpl, 1, 1));
  EXPECT_TRUE(BvhToMotion(file, kSmpl));
  BvhFile longer = file;
  longer.joints[2].offset.y() += 0.2;
  EXPECT_FALSE(BvhToMotion(longer, kSmpl));
  BvhFile renamed = file;
  renamed.joints[1].name = "LeftUpLeg";
  EXPECT_FALSE(BvhToMotion(renamed, kSmpl));
  EXPECT_FALSE(BvhToMotion(ParseBvh(kArm, "arm"), kSmpl));
}

TEST(Bvh, NamesLineTokenAndExpectation) {
  const std::string good = kArm;
  const auto broken = [&](const std::string& from, const std::string& to, const std::string& where,
                          const std::string& what) {
    SCOPED_TRACE(from + " -> " + to);
    std::string text = good;
    const size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
    ExpectError(ErrorCode::kInvalidArgument, where, [&] { ParseBvh(text, "arm"); });
    ExpectError(ErrorCode::kInvalidArgument, what, [&] { ParseBvh(text, "arm"); });
  };
  broken("HIERARCHY", "HIERARCHIE", "arm:1", "expected 'HIERARCHY'");
  broken("OFFSET 1 2 3", "OFFSET 1 two 3", "arm:4", "found 'two'");
  broken("Zrotation Yrotation Xrotation", "Zrotation Wrotation Xrotation", "arm:5", "Wrotation");
  broken("Zrotation Yrotation Xrotation", "Zrotation Yrotation Zrotation", "arm:5",
         "does not have already");
  broken("CHANNELS 6", "CHANNELS 10", "arm:5", "of 0 to 9");
  broken("20 10 30", "20 10", "arm:", "the end of the file");
  broken("20 10 30", "20 10", "arm:", "2 frames of 10 values, as the header says; there are 19");
  broken("Frames: 2", "Frames: -2", "arm:17", "-2");
  broken("Frame Time: 0.0333333", "Frame Time: -1", "arm:18", "frame time");
  broken("20 10 30", "20 nan 30", "arm:20", "finite");
  broken("20 10 30", "20 1e999 30", "arm:20", "1e999");
  broken("}\r\nMOTION", "}\r\nROOT b\r\nMOTION", "arm:", "expected '{'");
  // Any prefix is refused, or read as something shorter with a word.
  for (size_t length = 0; length + 6 < good.size(); ++length) {
    try {
      EXPECT_FALSE(ParseBvh(good.substr(0, length), "arm").notes.empty()) << length;
    } catch (const Error&) {
    }
  }
  ExpectError(ErrorCode::kInvalidArgument, "without any", [] {
    ParseBvh("HIERARCHY ROOT a\n{ OFFSET 0 0 0 }\nMOTION Frames: 4000000000\nFrame Time: 0.1", "a");
  });
}

TEST(Bvh, NamesAMissingFile) {
  const TemporaryFolder folder;
  ExpectError(ErrorCode::kNotFound, "nowhere.bvh", [&] { ReadBvh(folder / "nowhere.bvh"); });
  const BvhFile file = MotionToBvh(kSmpl, fixtures::SmoothMotion(kSmpl, 1, 1));
  ExpectError(ErrorCode::kInternal, "cannot be written",
              [&] { WriteBvh(folder / "absent/a.bvh", file); });
  ExpectError(ErrorCode::kInvalidArgument, "0 frames", [&] { MotionToBvh(kSmpl, Motion{}); });
}

}  // namespace choreo::bvh_test
