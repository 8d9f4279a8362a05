#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "model/core/error.h"
#include "model/core/files/npy.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/resample.h"
#include "model/training/prepare/beat_grid.h"
#include "model/training/prepare/recordings.h"
#include "tests/support/expect_error.h"
#include "tests/support/music_files.h"
#include "tests/support/synthetic_clips.h"
#include "tests/support/tang2018_markers.h"
#include "tests/training/preparation.h"

/// Made-up recordings in tang61's layout.
namespace choreo::tang61_test {

constexpr double kFps = 25;

// A dancer who hurries and lingers once in `pulse_frames`.
Motion Pulsing(double pulse_frames, int frames = 400) {
  const Motion motion = testing_support::SyntheticClip("dance", 600, 0.3, false).motion;
  Motion pulsing;
  pulsing.fps = kFps;
  for (int f = 0; f < frames; ++f) {
    const double turn = 2 * std::numbers::pi / pulse_frames;
    const double at = f - 0.8 / turn * std::sin(turn * f);
    pulsing.frames.push_back(motion.frames[static_cast<size_t>(std::lround(at + 20))]);
  }
  return pulsing;
}

void WriteRows(const std::filesystem::path& path, const PositionClip& clip) {
  NpyArray array{
      {static_cast<int64_t>(clip.frames.size()), static_cast<int64_t>(clip.joint_names.size()), 3},
      std::vector<float>()};
  for (const Eigen::Matrix3Xd& frame : clip.frames) {
    for (const double value : frame.reshaped())
      std::get<std::vector<float>>(array.values).push_back(static_cast<float>(100 * value));
  }
  WriteNpy(path, array);
}

class Tang61Test : public Preparation {
 protected:
  Tang61Test() : Preparation("tang61") {}
  void Write(const std::string& name, const Motion& motion) {
    WriteRows(In() / (name + ".npy"), Tang61Markers(motion));
  }
};

TEST_F(Tang61Test, ConvertsADanceWithItsMusicUnstretched) {
  const Motion dance = testing_support::SyntheticClip("dance", 121, 0.3, false).motion;
  Write("DANCE_W_1", Resample(dance, kFps));
  WriteWav(In() / "DANCE_W_1.wav", Music(5));
  ASSERT_EQ(Prepare(options_), 1);
  const PreparedClip clip = Clip("DANCE_W_1");
  EXPECT_EQ(clip.source, "tang61");
  ASSERT_EQ(clip.motion.frames.size(), 121U);
  EXPECT_EQ(clip.audio.cols(), 121);
  const Skeleton& smpl = Skeleton::Smpl24();
  for (size_t f = 0; f < 121; f += 10) {
    const Eigen::Matrix3Xd ours = JointPositions(smpl, clip.motion.frames[f]);
    const Eigen::Matrix3Xd theirs = JointPositions(smpl, dance.frames[f]);
    for (const char* name : {"left_knee", "right_ankle", "left_elbow", "right_wrist"}) {
      const int joint = smpl.Find(name);
      // Relative to the hips, as the floor is fitted.
      EXPECT_LT(((ours.col(joint) - ours.col(0)) - (theirs.col(joint) - theirs.col(0))).norm(),
                0.08)
          << f << ' ' << name;
    }
  }
}

TEST_F(Tang61Test, FindsTheBeatGridFromSpeed) {
  Write("DANCE_C_1", Pulsing(25));
  Write("DANCE_W_1", Pulsing(48.4));
  Write("DANCE_T_1", Pulsing(73.5));
  ASSERT_EQ(Prepare(options_), 3);
  const auto number = [&](const char* name, const char* key) {
    return std::stod(Clip(name).notes.at(key));
  };
  EXPECT_DOUBLE_EQ(number("DANCE_C_1", "beat_period_s"), 0.5);
  EXPECT_DOUBLE_EQ(number("DANCE_C_1", "beat_offset_s"), 0);
  EXPECT_EQ(number("DANCE_C_1", "beats_per_bar"), 4);
  EXPECT_NEAR(number("DANCE_W_1", "beat_period_s"), 0.6453, 1e-4);
  EXPECT_EQ(number("DANCE_W_1", "beats_per_bar"), 3);
  for (const char* key : {"beat_period_s", "beat_offset_s", "beats_per_bar"})
    EXPECT_FALSE(Clip("DANCE_T_1").notes.contains(key)) << key;
}

TEST_F(Tang61Test, BeatsCountFromTheFirstKeptFrame) {
  PositionClip clip = Tang61Markers(Pulsing(25));
  for (size_t f = 0; f < 3; ++f) clip.frames[f].array() += 2;  // a calibration pose
  WriteRows(In() / "DANCE_R_1.npy", clip);
  ASSERT_EQ(Prepare(options_), 1);
  EXPECT_NEAR(std::stod(Clip("DANCE_R_1").notes.at("beat_offset_s")), 2 - 3 / kFps, 1e-9);
}

TEST_F(Tang61Test, AFileOfAnotherShapeIsNamed) {
  WriteRows(In() / "DANCE_C_1.npy", Tang2018Markers(Pulsing(25, 80)));
  EXPECT_EQ(Prepare(options_), 0);
  ExpectError(ErrorCode::kInvalidArgument, "its shape is not [frames, 21, 3]",
              [&] { ListRecordings(options_).at(0).read(); });
}

TEST(BeatGrid, SkippingKeepsBeatsWhereTheyAre) {
  const BeatGrid later = Skip({.period_s = 0.5, .offset_s = 0.1, .per_bar = 4}, 3.0);
  EXPECT_NEAR(later.offset_s, 1.1, 1e-12);  // 0.1 + two bars - 3
  EXPECT_EQ(later.per_bar, 4);
}

TEST(BeatGrid, APurePulseHasAllPowerAtItsPeriod) {
  PositionClip clip{
      .fps = kFps, .joint_names = {"joint"}, .frames = {Eigen::Matrix3Xd::Zero(3, 1)}};
  for (int f = 0; f < 1000; ++f) {
    Eigen::Matrix3Xd next = clip.frames.back();
    next(0, 0) += 1 + 0.5 * std::sin(2 * std::numbers::pi * f / 25);
    clip.frames.push_back(next);
  }
  EXPECT_NEAR(SpeedPowerAt(clip, 1.0), 1, 0.02);
  EXPECT_LT(SpeedPowerAt(clip, 1.5), 0.01);
  clip.frames.resize(2);
  ExpectError(ErrorCode::kInvalidArgument, "frames", [&] { SpeedPowerAt(clip, 1); });
}

}  // namespace choreo::tang61_test
