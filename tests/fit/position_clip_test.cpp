#include "model/fit/sources/position_clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/core/error.h"

namespace choreo::position_clip_test {

constexpr double kPi = std::numbers::pi;

// One joint whose x coordinate is a function of time.
template <typename Function>
PositionClip Signal(double fps, int frames, Function x) {
  PositionClip clip;
  clip.fps = fps;
  clip.joint_names = {"a"};
  for (int frame = 0; frame < frames; ++frame) {
    clip.frames.emplace_back(Eigen::Vector3d(x(frame / fps), 1, 2));
  }
  return clip;
}

double MiddleAmplitude(const PositionClip& clip) {
  double largest = 0;
  const size_t count = clip.frames.size();
  for (size_t frame = count / 4; frame < 3 * count / 4; ++frame)
    largest = std::max(largest, std::abs(clip.frames[frame](0, 0)));
  return largest;
}

TEST(LowPass, HalvesThePowerAtItsCutoffWithoutDelay) {
  for (const double frequency : {0.5, 4.0, 8.0}) {
    const auto sine = [frequency](double t) { return std::sin(2 * kPi * frequency * t); };
    const PositionClip filtered = LowPass(Signal(100, 1000, sine), 4.0);
    // |H|^2 of both Butterworth passes together, the bilinear transform's warping included.
    const double cutoff = 4.0 / std::pow(std::sqrt(2.0) - 1, 0.25);
    const double ratio = std::tan(kPi * frequency / 100) / std::tan(kPi * cutoff / 100);
    const double gain = 1 / (1 + std::pow(ratio, 4));
    EXPECT_NEAR(MiddleAmplitude(filtered), gain, 0.01) << frequency;
    if (frequency == 4.0) {
      EXPECT_NEAR(gain, std::sqrt(0.5), 0.01);
    }
    // Zero phase: still an odd function around a zero of the sine.
    EXPECT_NEAR(filtered.frames[500](0, 0), 0, 1e-3);
  }
}

TEST(LowPass, KeepsConstantsAndSlopesUpToTheEnds) {
  const PositionClip clip = Signal(30, 200, [](double t) { return 3 + 0.5 * t; });
  const PositionClip filtered = LowPass(clip, 6.0);
  for (size_t frame = 0; frame < clip.frames.size(); ++frame) {
    EXPECT_LT((filtered.frames[frame] - clip.frames[frame]).norm(), 1e-3) << frame;
  }
  EXPECT_EQ(LowPass(clip, 100.0).frames[17], clip.frames[17]);
}

TEST(ResamplePositions, FollowsASmoothCurveAndStretchesTime) {
  const auto curve = [](double t) { return std::sin(2 * t); };
  const PositionClip resampled = ResamplePositions(Signal(25, 251, curve), 30, 1.0125);
  EXPECT_EQ(resampled.frames.size(), static_cast<size_t>(10 * 1.0125 * 30) + 1);
  EXPECT_EQ(resampled.fps, 30);
  for (size_t frame = 2; frame + 2 < resampled.frames.size(); ++frame) {
    EXPECT_NEAR(resampled.frames[frame](0, 0), curve(static_cast<double>(frame) / 30 / 1.0125),
                1e-4);
  }
}

TEST(ResamplePositions, KeepsASingleFrame) {
  EXPECT_EQ(ResamplePositions(Signal(25, 1, [](double) { return 5.0; }), 30).frames.size(), 1U);
}

TEST(Spikes, AreInterpolatedAndJumpsAreNot) {
  PositionClip clip = Signal(30, 100, [](double t) { return t; });
  const PositionClip clean = clip;
  clip.frames[40](1, 0) += 3;
  clip.frames[41](1, 0) += 4;
  for (int frame = 70; frame < 100; ++frame) clip.frames[frame](2, 0) += 5;
  EXPECT_EQ(RemoveSpikes(14, 6, clip), 2);
  EXPECT_LT((clip.frames[40] - clean.frames[40]).norm(), 1e-9);
  EXPECT_LT((clip.frames[41] - clean.frames[41]).norm(), 1e-9);
  EXPECT_NEAR(clip.frames[75](2, 0), 7, 1e-9);
}

TEST(Clip, RefusesRaggedAndNonFiniteFrames) {
  PositionClip clip = Signal(30, 4, [](double t) { return t; });
  clip.frames[2] = Eigen::Matrix3Xd::Zero(3, 2);
  try {
    CheckClip(clip);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.field(), "clip.frames[2]");
  }
  clip = Signal(30, 4, [](double) { return std::nan(""); });
  EXPECT_THROW(CheckClip(clip), Error);
  clip.frames.clear();
  EXPECT_THROW(CheckClip(clip), Error);
}

}  // namespace choreo::position_clip_test
