#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "model/core/error.h"
#include "model/formats/arrays/amass_npz.h"
#include "model/formats/bvh/bvh.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/synthetic_clips.h"
#include "tests/training/preparation.h"

namespace choreo::prepare_test {

using testing_support::SyntheticClip;

class AmassTest : public Preparation {
 protected:
  AmassTest() : Preparation("amass") {}
};
class BvhTest : public Preparation {
 protected:
  BvhTest() : Preparation("bvh") {}
};

TEST_F(AmassTest, ConvertsFilesAndSkipsABrokenOne) {
  options_.terms = "ours";
  const PreparedClip clip = SyntheticClip("walk", 90, 0.2, false);
  NpzArchive npz;
  AddSmplMotion(clip.motion, nullptr, npz);
  std::filesystem::create_directories(In() / "subject");
  npz.Write(In() / "subject" / "walk.npz");
  std::ofstream(In() / "subject" / "broken.npz") << "no zip";

  EXPECT_EQ(Prepare(options_), 1);
  const PreparedClip prepared = Clip("subject_walk");
  EXPECT_EQ(prepared.notes.at("terms"), "ours");
  EXPECT_EQ(prepared.audio.cols(), 0);
  ASSERT_EQ(prepared.motion.frames.size(), 90U);
  for (size_t f = 0; f < 90; f += 10) {
    EXPECT_LT(ComparePoses(Skeleton::Smpl24(), prepared.motion.frames[f], clip.motion.frames[f])
                  .position_m,
              1e-4);
  }
  EXPECT_TRUE(Report("subject_broken").contains("skipped"));
  EXPECT_EQ(Report("subject_walk").at("frames"), 90);
}

// Our skeleton under motion capture's joint names, which make it a foreign one.
BvhFile Renamed(BvhFile file) {
  const std::map<std::string, std::string> names = {
      {"pelvis", "Hips"},   {"spine1", "Spine"}, {"spine2", "Spine1"},   {"spine3", "Spine2"},
      {"neck", "Neck"},     {"head", "Head"},    {"hip", "UpLeg"},       {"knee", "Leg"},
      {"ankle", "Foot"},    {"foot", "ToeBase"}, {"collar", "Shoulder"}, {"shoulder", "Arm"},
      {"elbow", "ForeArm"}, {"wrist", "Hand"},   {"hand", "HandThumb"}};
  for (BvhJoint& joint : file.joints) {
    if (joint.end_site) continue;
    std::string side, rest = joint.name;
    if (rest.rfind("left_", 0) == 0) side = "Left", rest = rest.substr(5);
    if (rest.rfind("right_", 0) == 0) side = "Right", rest = rest.substr(6);
    joint.name = side + names.at(rest);
  }
  for (BvhJoint& joint : file.joints) {
    if (joint.end_site) joint.name = file.joints[static_cast<size_t>(joint.parent)].name + "_end";
  }
  return file;
}

TEST_F(BvhTest, FitsAForeignBvhOfAnyUnitAndStatedRate) {
  options_.frame_rates = {{"inches", 30.0}};
  BvhFile file =
      Renamed(MotionToBvh(Skeleton::Smpl24(), SyntheticClip("walk", 90, 0.2, false).motion));
  for (BvhJoint& joint : file.joints) joint.offset /= 2.54;
  // Inches instead of centimetres, and a wrong rate in the header.
  file.values.topRows(3) /= 2.54;
  file.frame_time = 1.0 / 120;
  WriteBvh(In() / "inches.bvh", file);

  ASSERT_EQ(Prepare(options_), 1);
  const nlohmann::json report = Report("inches");
  EXPECT_LT(report.at("fit_error_m").get<double>(), 0.02);
  EXPECT_NEAR(report.at("frames").get<double>(), 90, 1);
}

TEST_F(BvhTest, ACalibrationPoseAtTheStartIsCut) {
  Motion motion = SyntheticClip("walk", 90, 0.2, false).motion;
  for (Pose& pose : motion.frames) {  // arms down, then a T-pose in front of it
    pose.rotations(2, Skeleton::Smpl24().Find("left_shoulder")) -= 1.2;
    pose.rotations(2, Skeleton::Smpl24().Find("right_shoulder")) += 1.2;
  }
  motion.frames.insert(motion.frames.begin(), RestPose(Skeleton::Smpl24()));
  WriteBvh(In() / "walk.bvh", Renamed(MotionToBvh(Skeleton::Smpl24(), motion)));

  ASSERT_EQ(Prepare(options_), 1);
  EXPECT_EQ(Clip("walk").motion.frames.size(), 90U);
  EXPECT_EQ(Report("walk").at("frames_cut"), 1);
}

TEST_F(BvhTest, NothingToPrepareIsAnError) {
  EXPECT_THROW(Prepare(options_), Error);
  options_.input = folder_ / "nowhere";
  EXPECT_THROW(Prepare(options_), Error);
}

}  // namespace choreo::prepare_test
