#include "model/dance/delivery/quality_meter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/motion/kinematics/kinematics.h"

namespace choreo::quality_report_test {

Pose Standing() { return RestPose(Skeleton::Smpl24()); }

Motion Sliding(double metres_per_second, double height, int frames) {
  Motion motion;
  for (int i = 0; i < frames; ++i) {
    Pose pose = Standing();
    pose.root_position.x() += metres_per_second * i / 30;
    pose.root_position.y() += height;
    motion.frames.push_back(pose);
  }
  return motion;
}

TEST(QualityReport, SkatingIsAToeThatSlidesNearTheFloor) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  EXPECT_DOUBLE_EQ(MeasureMotion(skeleton, Sliding(0.3, 0, 31)).skate_ratio, 1);
  EXPECT_DOUBLE_EQ(MeasureMotion(skeleton, Sliding(0.19, 0, 31)).skate_ratio, 0);
  EXPECT_DOUBLE_EQ(MeasureMotion(skeleton, Sliding(0.3, 0.1, 31)).skate_ratio, 0);
  // A third of the steps.
  Motion motion = Sliding(0.3, 0, 11);
  for (int i = 0; i < 20; ++i) motion.frames.push_back(motion.frames.back());
  EXPECT_DOUBLE_EQ(MeasureMotion(skeleton, motion).skate_ratio, 10.0 / 30);
}

TEST(QualityReport, SupportIsTheShareOfSupportedOrBallisticFrames) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  EXPECT_EQ(MeasureMotion(skeleton, Sliding(0.3, 0, 31)).support, 1);
  EXPECT_EQ(MeasureMotion(skeleton, Sliding(0.3, 0.1, 31)).support, 0);  // the body hovers
  // Half of the time each; the upward jerk in between does not count as a throw.
  Motion motion = Sliding(0, 0, 50);
  const Motion hovers = Sliding(0, 0.1, 50);
  motion.frames.insert(motion.frames.end(), hovers.frames.begin(), hovers.frames.end());
  EXPECT_NEAR(*MeasureMotion(skeleton, motion).support, 0.5, 0.05);
  Skeleton headless = skeleton;
  headless.joint_names[static_cast<size_t>(headless.Find("head"))] = "hat";
  EXPECT_FALSE(MeasureMotion(headless, motion).support);
}

TEST(QualityReport, SpeedsAreMeansOverRequestedFrames) {
  const Skeleton& skeleton = Skeleton::Smpl24();
  const Motion motion = Sliding(0.3, 0, 31);
  QualityMeter meter(skeleton, 30, 0);
  for (size_t i = 0; i < motion.frames.size(); ++i) {
    DanceFrame frame;
    frame.pose = motion.frames[i];
    if (i >= 20) frame.asked_speeds = {0.04F, 0.02F, 0, 0, i % 2 == 0 ? 0.03F : 0.05F};
    meter.Add(frame);
  }
  const auto speeds = meter.Report().part_speeds;
  ASSERT_EQ(speeds.size(), static_cast<size_t>(kBodyParts));
  EXPECT_NEAR(speeds[0].asked, 0.04, 1e-8);
  EXPECT_NEAR(speeds[4].asked, (6 * 0.03 + 5 * 0.05) / 11, 1e-8);
  // The root alone moves, a centimetre a frame: the other joints are seen from it.
  EXPECT_NEAR(speeds[0].danced, 0.01 * WeighBodyParts(skeleton)(0, 0), 1e-8);
  EXPECT_NEAR(speeds[1].danced, 0, 1e-8);
  EXPECT_TRUE(MeasureMotion(skeleton, motion).part_speeds.empty());
}

TEST(QualityReport, BeatHitRateCountsKinematicBeatsNearMusicBeats) {
  // The whole body sways: speed has its maxima where the sine crosses zero, every 15 frames.
  Motion motion;
  for (int i = 0; i < 121; ++i) {
    Pose pose = Standing();
    pose.root_position.x() = 0.3 * std::sin(3.14159265358979 * (i + 0.25) / 15);
    motion.frames.push_back(pose);
  }
  QualityMeter meter(Skeleton::Smpl24(), motion.fps, 0);
  for (const Pose& pose : motion.frames) meter.Add({.pose = pose});
  std::vector<double> beats;
  for (int i = 1; i < 8; ++i) beats.push_back(0.5 * i);
  const QualityReport on = meter.Report(beats);
  ASSERT_TRUE(on.beat_hit_rate);
  EXPECT_DOUBLE_EQ(*on.beat_hit_rate, 1);
  EXPECT_NEAR(*on.beat_coverage, 1, 0.15);
  for (double& beat : beats) beat += 7.0 / 30;
  EXPECT_DOUBLE_EQ(*meter.Report(beats).beat_hit_rate, 0);
  EXPECT_FALSE(meter.Report().beat_hit_rate);
  const std::vector<double> elsewhere = {-50, 500};
  EXPECT_FALSE(meter.Report(elsewhere).beat_hit_rate);
}

TEST(QualityReport, AccelerationsAroundKeys) {
  // At rest, then one step of 1 cm, then at rest: second differences of 1 cm on both sides.
  QualityMeter meter(Skeleton::Smpl24(), 30, 100);
  for (int i = 0; i < 40; ++i) {
    Pose pose = Standing();
    if (i >= 20) pose.root_position.x() += 0.01;
    meter.Add({pose, {}, -2.0F});
    if (i == 18 || i == 30)
      meter.AddKey({.id = i == 18 ? "near" : "far", .raw_error_m = 0.5, .correction_m = 0.6});
  }
  const QualityReport report = meter.Report();
  ASSERT_EQ(report.keys.size(), 2u);
  EXPECT_EQ(report.measured_from, 100);
  EXPECT_EQ(report.frames, 40);
  EXPECT_EQ(report.keys[0].frame, 118);
  EXPECT_NEAR(report.keys[0].max_acceleration, 9, 1e-3);  // 0.01 * 30^2
  EXPECT_NEAR(report.keys[1].max_acceleration, 0, 1e-3);
  EXPECT_NEAR(report.max_key_acceleration, 9, 1e-3);
  EXPECT_NEAR(report.p95_acceleration, 9, 1e-3);  // 2 of 38 frames
  EXPECT_EQ(report.log_likelihood, -2);
  EXPECT_DOUBLE_EQ(report.keys[0].raw_error_m, 0.5);
}

TEST(QualityReport, HasNoLikelihoodIfTheModelHasNone) {
  QualityMeter meter(Skeleton::Smpl24(), 30, 0);
  meter.Add({.pose = Standing()});
  EXPECT_FALSE(meter.Report().log_likelihood);
  meter.Add({.pose = Standing(), .log_likelihood = -2.0F});
  EXPECT_FALSE(meter.Report().log_likelihood) << "not of all frames";
}

TEST(QualityReport, AnEmptyDanceHasAReport) {
  const QualityReport report = QualityMeter(Skeleton::Smpl24(), 30, 5).Report();
  EXPECT_EQ(report.frames, 0);
  EXPECT_EQ(report.skate_ratio, 0);
  EXPECT_FALSE(report.beat_hit_rate);
}

}  // namespace choreo::quality_report_test
