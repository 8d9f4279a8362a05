#include "model/training/prepare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "model/core/error.h"
#include "model/formats/amass_npz.h"
#include "model/formats/bvh.h"
#include "model/motion/kinematics.h"
#include "model/training/prepared_clip.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/temporary_folder.h"

namespace choreo {
namespace {

using testing_support::SyntheticClip;

class PrepareTest : public testing::Test {
 protected:
  PrepareOptions Options(const std::string& layout) {
    std::filesystem::create_directories(folder_ / "in");
    PrepareOptions options;
    options.layout = layout;
    options.input = folder_ / "in";
    options.output = folder_ / "out";
    options.terms = "ours";
    options.jobs = 1;
    return options;
  }
  nlohmann::json Report() {
    std::ifstream file(folder_ / "out" / "report.json");
    return nlohmann::json::parse(file);
  }
  TemporaryFolder folder_;
};

TEST_F(PrepareTest, AmassComesThroughAndABrokenFileIsNamedAndSkipped) {
  const PrepareOptions options = Options("amass");
  const PreparedClip clip = SyntheticClip("walk", 90, 0.2, false);
  NpzArchive npz;
  AddSmplMotion(Skeleton::Smpl24(), clip.motion, nullptr, npz);
  std::filesystem::create_directories(options.input / "subject");
  npz.Write(options.input / "subject" / "walk.npz");
  std::ofstream(options.input / "subject" / "broken.npz") << "no zip";

  EXPECT_EQ(Prepare(options), 1);
  const PreparedClip prepared = ReadPreparedClip(options.output / "subject_walk.clip");
  EXPECT_EQ(prepared.notes.at("terms"), "ours");
  EXPECT_EQ(prepared.audio.cols(), 0);
  ASSERT_EQ(prepared.motion.frames.size(), 90U);
  for (size_t f = 0; f < 90; f += 10) {
    EXPECT_LT(ComparePoses(Skeleton::Smpl24(), prepared.motion.frames[f], clip.motion.frames[f])
                  .position_m,
              1e-4);
  }
  std::map<std::string, nlohmann::json> by_name;
  for (const auto& report : Report()) by_name[report.at("name")] = report;
  EXPECT_TRUE(by_name.at("subject_broken").contains("skipped"));
  EXPECT_EQ(by_name.at("subject_walk").at("frames"), 90);
}

// Our skeleton under the joint names of motion capture, which make it a foreign one.
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

TEST_F(PrepareTest, AForeignBvhIsFittedWhateverItsUnitAndStatedRate) {
  PrepareOptions options = Options("bvh");
  options.frame_rates = {{"inches", 30.0}};
  BvhFile file =
      Renamed(MotionToBvh(Skeleton::Smpl24(), SyntheticClip("walk", 90, 0.2, false).motion));
  for (BvhJoint& joint : file.joints) joint.offset /= 2.54;
  // Inches instead of centimetres, and a header that lies about the rate.
  file.values.topRows(3) /= 2.54;
  file.frame_time = 1.0 / 120;
  WriteBvh(options.input / "inches.bvh", file);

  ASSERT_EQ(Prepare(options), 1);
  const nlohmann::json report = Report().at(0);
  EXPECT_LT(report.at("fit_error_m").get<double>(), 0.02);
  EXPECT_NEAR(report.at("frames").get<double>(), 90, 1);
}

TEST_F(PrepareTest, ACalibrationPoseAtTheStartIsCut) {
  const PrepareOptions options = Options("bvh");
  Motion motion = SyntheticClip("walk", 90, 0.2, false).motion;
  for (Pose& pose : motion.frames) {  // arms down, then a T-pose in front of it
    pose.rotations(2, Skeleton::Smpl24().Find("left_shoulder")) -= 1.2;
    pose.rotations(2, Skeleton::Smpl24().Find("right_shoulder")) += 1.2;
  }
  motion.frames.insert(motion.frames.begin(), RestPose(Skeleton::Smpl24()));
  WriteBvh(options.input / "walk.bvh", Renamed(MotionToBvh(Skeleton::Smpl24(), motion)));

  ASSERT_EQ(Prepare(options), 1);
  EXPECT_EQ(ReadPreparedClip(options.output / "walk.clip").motion.frames.size(), 90U);
  EXPECT_EQ(Report().at(0).at("frames_cut"), 1);
}

TEST_F(PrepareTest, NothingToPrepareIsAnError) {
  EXPECT_THROW(Prepare(Options("bvh")), Error);
  PrepareOptions options = Options("bvh");
  options.input = folder_ / "nowhere";
  EXPECT_THROW(Prepare(options), Error);
}

}  // namespace
}  // namespace choreo
