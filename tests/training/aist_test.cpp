#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "model/audio/music/feature_stream.h"
#include "model/audio/signal/mfcc.h"
#include "model/fit/solver/fit_clip.h"
#include "model/formats/arrays/amass_npz.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/resample.h"
#include "model/training/clips/clip_split.h"
#include "tests/support/expect_error.h"
#include "tests/support/music_files.h"
#include "tests/support/pickles.h"
#include "tests/support/synthetic_clips.h"
#include "tests/training/preparation.h"

/// Made-up recordings in AIST++'s layout.
namespace choreo::aist_test {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

const std::string kOne = "gBR_sBM_cAll_d04_mBR0_ch01", kTwo = "gHO_sBM_cAll_d19_mHO5_ch02",
                  kThree = "gLO_sFM_cAll_d13_mLO2_ch08", kFour = "gPO_sBM_cAll_d10_mPO1_ch03",
                  kFailed = "gWA_sBM_cAll_d26_mWA0_ch05";

class AistTest : public Preparation {
 protected:
  AistTest() : Preparation("aist") {
    std::filesystem::create_directories(In() / "motions");
    std::filesystem::create_directories(In() / "splits");
    WriteList("splits/crossmodal_train.txt", kOne + "\n");
    WriteList("splits/crossmodal_val.txt", kTwo + "\n");
    WriteList("splits/crossmodal_test.txt", kThree);
    WriteList("ignore_list.txt", kFailed + "\n");
  }
  void WriteList(const std::string& name, const std::string& text) {
    std::ofstream(In() / name) << text;
  }
  /// AIST++'s conventions: 60 fps, the scaled body's translation, which is the pelvis minus its
  /// rest position. `lift`: error of the floor, metres.
  void WriteMotion(const std::string& name, double lift = 0, const std::string& without = "") {
    const Motion dance = Resample(Dance(), 60);
    std::vector<double> poses, trans;
    for (const Pose& pose : dance.frames) {
      poses.insert(poses.end(), pose.rotations.data(), pose.rotations.data() + 72);
      const Eigen::Vector3d at =
          kScaling * (pose.root_position + Eigen::Vector3d(0, lift, 0) - SmplRestPelvis());
      trans.insert(trans.end(), at.data(), at.data() + 3);
    }
    const auto frames = static_cast<int64_t>(dance.frames.size());
    std::map<std::string, NpyArray> arrays = {{"smpl_poses", {{frames, 72}, poses}},
                                              {"smpl_trans", {{frames, 3}, trans}},
                                              {"smpl_scaling", {{1}, std::vector{kScaling}}},
                                              {"smpl_loss", {{1}, std::vector{0.1}}}};
    arrays.erase(without);
    WritePickle(In() / "motions" / (name + ".pkl"), arrays);
  }
  static Motion Dance() {
    Motion motion = testing_support::SyntheticClip("dance", 90, 0.3, false).motion;
    Ground(Smpl(), motion);
    return motion;
  }
  static constexpr double kScaling = 93.5;  // of a body in centimetres
};

TEST_F(AistTest, ConvertsADanceWithItsSongAndFloor) {
  WriteMotion(kOne);
  WriteMotion(kTwo, -0.2);
  std::filesystem::create_directories(In() / "music");
  const std::vector<float> music = Music(4);
  WriteWav(In() / "music" / "mBR0.wav", music);
  ASSERT_EQ(Prepare(options_), 2);

  const PreparedClip one = Clip(kOne), two = Clip(kTwo);
  const Motion dance = Dance();
  EXPECT_EQ(one.source, "aist");
  EXPECT_EQ(one.notes.at("genre"), "gBR");
  EXPECT_EQ(one.motion.fps, 30);
  ASSERT_EQ(one.motion.frames.size(), dance.frames.size());
  for (size_t f = 0; f < dance.frames.size(); ++f) {
    const PoseError error = ComparePoses(Smpl(), one.motion.frames[f], dance.frames[f]);
    EXPECT_LT(error.position_m, 0.01) << f;  // a grounded dance, grounded once more
    EXPECT_LT(error.angle_deg, 0.01) << f;
    EXPECT_LT(ComparePoses(Smpl(), two.motion.frames[f], one.motion.frames[f]).position_m, 1e-4);
  }
  FeatureStream stream(kMusicRate, 1);
  stream.Push(music);
  stream.Finish();
  ASSERT_EQ(one.audio.cols(), 90);
  for (const int64_t f : {0, 31, 89}) {
    Eigen::Vector<float, kMfccCount> row;
    MfccOfMelDb(stream.Bands(f), std::span<float, kMfccCount>(row.data(), kMfccCount));
    EXPECT_TRUE(one.audio.col(f).isApprox(row)) << f;
  }
  EXPECT_EQ(two.audio.cols(), 0);
  const json report = Read("report.json");
  ASSERT_EQ(report.size(), 2U);
  EXPECT_TRUE(report[0].at("warnings").empty());
  ASSERT_EQ(report[1].at("warnings").size(), 2U);
  EXPECT_THAT(report[1].at("warnings")[0],
              testing::StartsWith("moved by 0.22 m in height onto the floor"));
  EXPECT_EQ(report[1].at("warnings")[1], "no music");
}

TEST_F(AistTest, ListsBecomeSplitsAndTheRestIsUnused) {
  for (const std::string& name : {kOne, kTwo, kThree, kFour, kFailed}) WriteMotion(name);
  ASSERT_EQ(Prepare(options_), 4);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / (kFailed + ".clip")));
  EXPECT_EQ(Read("splits.json"), (json{{"aist",
                                        {{"train", json::array({kOne})},
                                         {"validation", json::array({kTwo})},
                                         {"test", json::array({kThree})},
                                         {"unused", json::array({kFour})}}}}));
  const auto names = [&](const std::string& group) {
    std::vector<std::string> read;
    for (const PreparedClip& clip :
         LoadClips({folder_ / "out"}, folder_ / "out" / "splits.json", group))
      read.push_back(clip.name);
    return read;
  };
  EXPECT_THAT(names(kTrainGroup), ElementsAre(kOne));
  EXPECT_THAT(names(kValidationGroup), ElementsAre(kTwo));
  EXPECT_THAT(names("test"), ElementsAre(kThree));
}

TEST_F(AistTest, NamesAndSkipsInvalidFiles) {
  WriteMotion(kOne, 0, "smpl_scaling");
  std::ofstream(In() / "motions" / (kTwo + ".pkl")) << "\x80\x04"
                                                    << "cos\nsystem\n.";
  WriteMotion("dance");
  WriteMotion(kThree);
  ASSERT_EQ(Prepare(options_), 1);
  std::map<std::string, std::string> skipped;
  for (const json& clip : Read("report.json")) skipped[clip.at("name")] = clip.value("skipped", "");
  EXPECT_THAT(skipped.at(kOne), HasSubstr(kOne + ".pkl: has no smpl_scaling"));
  EXPECT_THAT(skipped.at(kTwo), HasSubstr("it names 'os.system'"));
  EXPECT_THAT(skipped.at("dance"), HasSubstr("names no song"));
  EXPECT_EQ(skipped.at(kThree), "");
}

TEST_F(AistTest, RefusesAnIncompleteFolderAtOnce) {
  ExpectError(ErrorCode::kNotFound, "no motion (*.pkl)", [&] { Prepare(options_); });
  WriteMotion(kOne);
  WriteList("splits/crossmodal_val.txt", kOne);
  ExpectError(ErrorCode::kInvalidArgument,
              "crossmodal_val.txt: " + kOne + " is in crossmodal_train.txt too",
              [&] { Prepare(options_); });
  std::filesystem::remove(In() / "splits" / "crossmodal_test.txt");
  WriteList("splits/crossmodal_val.txt", kTwo);
  ExpectError(ErrorCode::kNotFound, "crossmodal_test.txt: no such file",
              [&] { Prepare(options_); });
  std::filesystem::remove_all(In() / "motions");
  ExpectError(ErrorCode::kNotFound, "motions: no such folder", [&] { Prepare(options_); });
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / (kOne + ".clip")));
}

}  // namespace choreo::aist_test
