#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/audio/music/feature_stream.h"
#include "model/audio/signal/mfcc.h"
#include "model/core/error.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/resample.h"
#include "tests/support/expect_error.h"
#include "tests/support/music_files.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/tang2018_files.h"
#include "tests/support/tang2018_markers.h"
#include "tests/training/preparation.h"

/// Made-up recordings in the two layouts of tang2018.
namespace choreo::tang2018_test {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

const Skeleton& Smpl() { return Skeleton::Smpl24(); }

// At the 25 fps of the recordings, in centimetres, above a floor that rises by `slope` to the
// dancer's left.
PositionClip Record(double slope, int frames = 121) {
  const Motion motion = testing_support::SyntheticClip("dance", frames, 0.3, false).motion;
  PositionClip clip = Tang2018Markers(Resample(motion, 25));
  for (Eigen::Matrix3Xd& frame : clip.frames) {
    frame.row(1) += slope * frame.row(0);
    frame *= 100;
  }
  return clip;
}

void WritePublicLayout(const std::filesystem::path& folder, const PositionClip& clip, int start) {
  std::filesystem::create_directories(folder);
  json skeletons = {{"length", clip.frames.size()}};
  for (const Eigen::Matrix3Xd& frame : clip.frames) {
    const Eigen::Vector3d centre = frame.rowwise().mean();
    skeletons["center"].push_back({centre.x(), centre.y(), centre.z()});
    json joints;
    for (Eigen::Index i = 0; i < frame.cols(); ++i) {
      const Eigen::Vector3d point = frame.col(i) - centre;
      joints.push_back({point.x(), point.y(), point.z()});
    }
    skeletons["skeletons"].push_back(joints);
  }
  std::ofstream(folder / "skeletons.json") << skeletons;
  std::ofstream(folder / "config.json")
      << json{{"start_position", start}, {"end_position", start + clip.frames.size()}};
}

class Tang2018Test : public Preparation {
 protected:
  Tang2018Test() : Preparation("tang2018") { options_.jobs = 2; }
  // Whether frame f of the clip has row f + first of the music.
  static void ExpectMusicFrom(int64_t first, const PreparedClip& clip,
                              const std::vector<float>& samples) {
    FeatureStream stream(kMusicRate, 1);
    stream.Push(samples);
    stream.Finish();
    ASSERT_EQ(clip.audio.cols(), static_cast<Eigen::Index>(clip.motion.frames.size()));
    for (Eigen::Index f = 0; f < clip.audio.cols(); f += 7) {
      Eigen::Vector<float, kMfccCount> row;
      MfccOfMelDb(stream.Bands(first + f), std::span<float, kMfccCount>(row.data(), kMfccCount));
      EXPECT_TRUE(clip.audio.col(f).isApprox(row)) << "frame " << f;
    }
  }
};

TEST_F(Tang2018Test, BothLayoutsGiveTheSameDanceEachWithItsMusic) {
  const PositionClip clip = Record(0);
  const std::vector<float> music = Music(8);
  WriteTang2018Npy(In() / "DANCE_C_1.npy", clip);
  WriteWav(In() / "DANCE_C_1.wav", music);
  WritePublicLayout(In() / "DANCE_C_2", clip, 50);
  WriteWav(In() / "DANCE_C_2" / "audio.wav", music);

  ASSERT_EQ(Prepare(options_), 2);
  const PreparedClip one = Clip("DANCE_C_1"), two = Clip("DANCE_C_2");
  ASSERT_EQ(one.motion.frames.size(), 121U);
  ASSERT_EQ(two.motion.frames.size(), 121U);
  for (size_t f = 0; f < 121; f += 10) {
    EXPECT_LT(ComparePoses(Smpl(), one.motion.frames[f], two.motion.frames[f]).position_m, 1e-3);
  }
  ExpectMusicFrom(0, one, music);
  ExpectMusicFrom(60, two, music);  // 50 frames of 25 a second
  EXPECT_EQ(Report("DANCE_C_2").at("music_start_s"), 2);
  EXPECT_LT(Report("DANCE_C_1").at("fit_error_m").get<double>(), 0.03);
  EXPECT_TRUE(Report("DANCE_C_1").at("warnings").empty());
}

TEST_F(Tang2018Test, WaltzIsStretchedToItsMusic) {
  WriteTang2018Npy(In() / "DANCE_W_1.npy", Record(0));
  ASSERT_EQ(Prepare(options_), 1);
  // 4 s x 1.0125 at 30 fps.
  EXPECT_EQ(Clip("DANCE_W_1").motion.frames.size(), 122U);
  EXPECT_THAT(Report("DANCE_W_1").at("warnings").get<std::vector<std::string>>(),
              Contains("no music"));
}

TEST_F(Tang2018Test, MusicThatEndsEarlyIsReported) {
  WriteTang2018Npy(In() / "DANCE_C_1.npy", Record(0));
  WriteWav(In() / "DANCE_C_1.wav", Music(2));
  ASSERT_EQ(Prepare(options_), 1);
  EXPECT_THAT(Report("DANCE_C_1").at("warnings").get<std::vector<std::string>>(),
              Contains(HasSubstr("the music ends 2.0 s before")));
}

TEST_F(Tang2018Test, ATiltedFloorIsLevelled) {
  WriteTang2018Npy(In() / "DANCE_C_1.npy", Record(0.06, 361));
  WriteTang2018Npy(In() / "DANCE_C_2.npy", Record(0, 361));
  ASSERT_EQ(Prepare(options_), 2);
  EXPECT_NEAR(Report("DANCE_C_1").at("floor_slope").get<double>(), 0.06, 0.025);
  EXPECT_LT(Report("DANCE_C_2").at("floor_slope").get<double>(), 0.03);
  // The floor rises and falls by 12 cm on the dancer's circle, 2 m across.
  const Motion tilted = Clip("DANCE_C_1").motion, level = Clip("DANCE_C_2").motion;
  ASSERT_EQ(tilted.frames.size(), level.frames.size());
  for (size_t f = 0; f < level.frames.size(); ++f) {
    EXPECT_NEAR(tilted.frames[f].root_position.y(), level.frames[f].root_position.y(), 0.03)
        << "frame " << f;
  }
}

TEST_F(Tang2018Test, NativeSkeletonIsMeasuredOnAllRecordingsAndKeptInEachClip) {
  WriteTang2018Npy(In() / "DANCE_C_1.npy", Record(0));
  PositionClip taller = Record(0);
  for (Eigen::Matrix3Xd& frame : taller.frames) frame *= 1.1;
  WriteTang2018Npy(In() / "DANCE_C_2.npy", taller);
  std::ofstream(In() / "DANCE_C_3.npy") << "broken";
  options_.native_skeleton = true;
  ASSERT_EQ(Prepare(options_), 2);
  const PreparedClip one = Clip("DANCE_C_1"), two = Clip("DANCE_C_2");
  EXPECT_EQ(one.skeleton, two.skeleton);
  EXPECT_EQ(one.skeleton.name, "tang2018");
  ASSERT_EQ(one.skeleton.joints(), 23);
  for (const Pose& pose : one.motion.frames) ASSERT_EQ(pose.rotations.cols(), 23);
  // A twentieth longer than the smaller dancer.
  const Skeleton& smpl = Smpl();
  const double thigh =
      0.5 * (smpl.offsets.col(smpl.left_knee).norm() + smpl.offsets.col(smpl.right_knee).norm());
  EXPECT_NEAR(one.skeleton.offsets.col(one.skeleton.left_knee).norm(), 1.05 * thigh, 1e-5);
  EXPECT_LT(Report("DANCE_C_1").at("fit_error_m").get<double>(), 0.03);
  EXPECT_EQ(Report("DANCE_C_1").at("skeleton"), "tang2018");
  EXPECT_TRUE(Report("DANCE_C_3").contains("skipped"));
}

TEST_F(Tang2018Test, OtherLayoutsHaveNoNativeSkeleton) {
  options_.layout = "bvh";
  options_.native_skeleton = true;
  ExpectError(ErrorCode::kInvalidArgument, "--native-skeleton: is for tang2018, 'bvh'",
              [&] { Prepare(options_); });
}

TEST_F(Tang2018Test, TwoRecordingsOfOneNameAreRefused) {
  WriteTang2018Npy(In() / "DANCE_C_1.npy", Record(0));
  WritePublicLayout(In() / "DANCE_C_1", Record(0), 0);
  try {
    Prepare(options_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'DANCE_C_1.clip'"));
  }
}

}  // namespace choreo::tang2018_test
