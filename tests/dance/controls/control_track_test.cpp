#include "model/dance/controls/control_track.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"
#include "tests/support/fake_sampler.h"

namespace choreo::control_track_test {

using testing::HasSubstr;

class ControlTrackTest : public testing::Test {
 protected:
  static ControlRequest PathRequest(std::vector<int64_t> frames, const std::vector<double>& x,
                                    const std::vector<double>& heights = {}) {
    RootPath path{.frames = std::move(frames), .heights = heights};
    for (const double one : x) path.points.emplace_back(one, 0);
    return {path, {}};
  }
  static ControlRequest Velocity(VelocityRequest velocity) { return {{}, std::move(velocity)}; }

  struct Asked {
    Controls controls;
    std::vector<Warning> warnings;
  };
  Asked For(int64_t first_frame, int frames) const {
    TransitionSpec spec;
    spec.first_frame = first_frame;
    spec.frames = frames;
    spec.history = {here_};
    spec.target = target_;
    std::vector<Warning> warnings;
    track_.FillControls("landing", &spec, &warnings);
    return {spec.controls, warnings};
  }
  void AimAt(double x) {
    target_.emplace().pose = here_;
    target_->pose.root_position.x() = x;
  }
  void ExpectRefused(const ControlRequest& request, const std::string& message) const {
    ExpectError(ErrorCode::kInvalidArgument, message,
                [&] { CheckControls(request, sampler_.model(), "controls"); });
  }

  const ControlledSampler sampler_;
  const double standing_ = sampler_.model().skeleton.pelvis_height;
  ControlTrack track_{sampler_.model()};
  Pose here_ = RestPose(sampler_.model().skeleton);
  std::optional<Target> target_;
};

TEST_F(ControlTrackTest, GivesNothingOutsideThePath) {
  EXPECT_EQ(For(0, 60).controls[kRootPath].values.cols(), 0);
  track_.Set(PathRequest({100, 200}, {0, 1}), 0, "controls");
  EXPECT_EQ(For(0, 100).controls[kRootPath].values.cols(), 0);
  EXPECT_EQ(For(201, 60).controls[kRootPath].values.cols(), 0);
  EXPECT_EQ(For(100, 60).controls[kRootPath].values.cols(), 60);
  EXPECT_EQ(For(100, 60).controls[kVelocityFactors].values.cols(), 0);
}

TEST_F(ControlTrackTest, LaterPathsApplyToLaterTransitions) {
  track_.Set(PathRequest({0, 300}, {0, 3}), 0, "controls");
  track_.Set(PathRequest({0, 300}, {1, 1}), 60, "controls");
  EXPECT_NEAR(For(0, 120).controls[kRootPath].values(0, 119), 1.19, 1e-9);
  EXPECT_NEAR(For(60, 60).controls[kRootPath].values(0, 59), 1, 1e-9);
}

TEST_F(ControlTrackTest, APathMayComeInPieces) {
  track_.Set(PathRequest({0, 99}, {0, 0.99}), 0, "controls");
  track_.Set(PathRequest({100, 199}, {1, 1.99}), 0, "controls");
  const Eigen::Matrix3Xd path = For(0, 200).controls[kRootPath].values;
  for (const int frame : {0, 50, 99, 100, 150, 199})
    EXPECT_NEAR(path(0, frame), 0.01 * frame, 0.02) << frame;
  EXPECT_TRUE(For(0, 200).warnings.empty());
}

TEST_F(ControlTrackTest, PathsOutsideTheDanceChangeNothing) {
  track_.Set(PathRequest({0, 300}, {0, 3}), 0, "controls");
  track_.Set(PathRequest({0, 50}, {9, 9}), 60, "controls");     // over before it counts
  track_.Set(PathRequest({400, 500}, {9, 9}), 60, "controls");  // after all that is danced
  EXPECT_NEAR(For(60, 140).controls[kRootPath].values(0, 139), 1.99, 1e-9);
}

TEST_F(ControlTrackTest, WarnsOfADistantPathStart) {
  track_.Set(PathRequest({0, 300}, {0.4, 3}), 0, "controls");
  EXPECT_TRUE(For(0, 60).warnings.empty()) << "a step aside";
  track_.Set(PathRequest({30, 300}, {5, 7}), 0, "controls");
  const std::vector<Warning> warnings = For(0, 200).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, Warning::Code::kPathAway);
  EXPECT_EQ(warnings[0].frame, 30);
  EXPECT_EQ(warnings[0].message,
            "the root path is 4.34 m from the dancer at 1 s: the root is led there first");
  EXPECT_TRUE(For(60, 60).warnings.empty()) << "told once, where it takes over";
  EXPECT_THAT(For(30, 60).warnings[0].message, HasSubstr("is 4.99 m from the dancer at 1 s"))
      << "and from where she stands";
}

TEST_F(ControlTrackTest, NamesPartsThatMissedTheirSpeed) {
  QualityReport report;
  report.measured_from = 10;
  report.frames = 90;
  EXPECT_TRUE(track_.Missed(report).empty()) << "nothing was asked";
  report.part_speeds = {{0.02, 0.01}, {0.02, 0.0222}, {0.01, 0.0118}, {0, 0.002}, {0, 0.0009}};
  VelocityRequest velocity;
  velocity.factors = {1};
  velocity.parts = {"left_arm"};
  track_.Set(Velocity(velocity), 0, "controls");
  EXPECT_TRUE(track_.Missed(report).empty()) << "of the arm alone something was asked";
  velocity.parts.clear();
  track_.Set(Velocity(velocity), 0, "controls");
  const std::vector<Warning> warnings = track_.Missed(report);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, Warning::Code::kVelocityNotMet);
  EXPECT_EQ(warnings[0].frame, 99);
  EXPECT_EQ(warnings[0].message,
            "parts do not move as their velocity factors request, cm a frame on average: trunk 1 "
            "instead of 2, right_arm 1.18 instead of 1, left_leg 0.2 instead of 0");
}

TEST_F(ControlTrackTest, HeightsComeFromPathOrDancer) {
  here_.root_position.y() = 0.5;
  track_.Set(PathRequest({0, 100}, {0, 1}), 0, "controls");
  EXPECT_NEAR(For(0, 90).controls[kRootPath].values(1, 89), standing_, 1e-9);
  AimAt(0.89);
  target_->pose.root_position.y() = 0.7;
  EXPECT_NEAR(For(0, 90).controls[kRootPath].values(1, 89), 0.7, 1e-9);
  EXPECT_TRUE(For(0, 90).warnings.empty());
  track_.Set(PathRequest({0, 50, 100}, {0, 0.5, 1}, {0.5, 1.3, 0.6}), 0, "controls");
  target_.reset();
  EXPECT_NEAR(For(0, 90).controls[kRootPath].values(1, 50), 1.3, 1e-9);
}

TEST_F(ControlTrackTest, UnplacedKeyStandsUnlessThePathHasHeights) {
  track_.Set(PathRequest({0, 100}, {0, 1}), 0, "controls");
  AimAt(0);
  target_->mask.root_position = false;
  const Skeleton& skeleton = sampler_.model().skeleton;
  for (const int knee : {skeleton.left_knee, skeleton.right_knee})
    target_->pose.rotations(0, knee) = 0.8;
  for (const int hip : {skeleton.left_hip, skeleton.right_hip})
    target_->pose.rotations(0, hip) = -0.6;
  const double crouched = *StandingHeight(skeleton, target_->pose);
  ASSERT_LT(crouched, standing_ - 0.02);
  const Eigen::Matrix3Xd path = For(0, 90).controls[kRootPath].values;
  EXPECT_NEAR(path(1, 89), crouched, 1e-9);
  EXPECT_NEAR(path(0, 89), 0.89, 1e-9);
  target_->mask.joints.assign(24, false);
  target_->mask.joints[static_cast<size_t>(skeleton.left_elbow)] = true;
  EXPECT_NEAR(For(0, 90).controls[kRootPath].values(1, 89), standing_, 1e-9) << "legs are open";
  target_->mask.joints.clear();
  track_.Set(PathRequest({0, 100}, {0, 1}, {standing_, 1.4}), 0, "controls");
  EXPECT_GT(For(0, 90).controls[kRootPath].values(1, 89), standing_ + 0.2);
}

TEST_F(ControlTrackTest, WarnsOfAKeyOffThePathsHeight) {
  AimAt(0);
  target_->mask.root_position = false;
  const auto told = [&](double height) {
    track_.Set(PathRequest({0, 100}, {0, 1}, {height, height}), 0, "controls");
    return For(0, 90).warnings;
  };
  EXPECT_TRUE(told(standing_ + 0.04).empty());
  const std::vector<Warning> above = told(1.3), below = told(0.7);
  ASSERT_EQ(above.size(), 1u);
  EXPECT_EQ(above[0].code, Warning::Code::kKeyOffHeight);
  EXPECT_EQ(above[0].frame, 89);
  EXPECT_EQ(above[0].message,
            "key \"landing\" stands on the floor with its root at 0.98 m, the root path has 1.3 m: "
            "it is 0.32 m in the air; the path wins");
  ASSERT_EQ(below.size(), 1u);
  EXPECT_THAT(below[0].message, HasSubstr("it is 0.28 m too low for its feet"));
  // One that states where its root is wins instead; of one whose legs are open nothing is known.
  target_->mask.root_position = true;
  ASSERT_EQ(told(1.3).size(), 1u);
  EXPECT_EQ(told(1.3)[0].code, Warning::Code::kKeyOffPath);
  target_->mask.root_position = false;
  target_->mask.joints.assign(24, false);
  target_->mask.joints[static_cast<size_t>(sampler_.model().skeleton.left_elbow)] = true;
  EXPECT_TRUE(told(1.3).empty());
}

TEST_F(ControlTrackTest, WithoutHistoryStartsOnThePath) {
  EXPECT_EQ(track_.Stance(0, {}).root_position, RestPose(sampler_.model().skeleton).root_position);
  track_.Set(PathRequest({30, 90}, {4, 5}, {0.5, 0.5}), 0, "controls");
  EXPECT_EQ(track_.Stance(0, {}).root_position.x(), 0);
  EXPECT_NEAR(track_.Stance(30, {}).root_position.x(), 4, 1e-9);
  EXPECT_NEAR(track_.Stance(30, {}).root_position.y(), standing_, 1e-9) << "at rest, not crouched";
  // A key on the first frame is already reached.
  AimAt(7);
  target_->pose.rotations(2, 16) = 1;
  EXPECT_EQ(track_.Stance(30, target_).root_position.x(), 7);
  EXPECT_EQ(track_.Stance(30, target_).rotations(2, 16), 1);
  target_->mask.root_position = false;
  EXPECT_NEAR(track_.Stance(30, target_).root_position.x(), 4, 1e-9);
  EXPECT_NEAR(track_.Stance(30, target_).root_position.y(), 0.5, 1e-9);
}

TEST_F(ControlTrackTest, NamesAPathThatBeginsAfterTheEnd) {
  EXPECT_TRUE(track_.BehindEnd(60).empty());
  track_.Set(PathRequest({100, 200}, {0, 1}), 0, "controls");
  EXPECT_TRUE(track_.BehindEnd(101).empty());
  const std::vector<Warning> warnings = track_.BehindEnd(100);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, Warning::Code::kPathBehindEnd);
  EXPECT_EQ(warnings[0].message,
            "the root path begins at 3.33 s, after the last frame at 3.3 s: it has no effect");
  track_.Set(PathRequest({0, 200}, {0, 1}), 0, "controls");  // what replaces it is danced
  EXPECT_TRUE(track_.BehindEnd(100).empty());
}

TEST_F(ControlTrackTest, KeyOverridesThePathWithAWarning) {
  track_.Set(PathRequest({0, 300}, {0, 3}), 0, "controls");
  AimAt(1.09);
  const Asked asked = For(0, 90);
  EXPECT_NEAR(asked.controls[kRootPath].values(0, 89), 1.09, 1e-9);
  ASSERT_EQ(asked.warnings.size(), 1u);
  EXPECT_EQ(asked.warnings[0].code, Warning::Code::kKeyOffPath);
  EXPECT_EQ(asked.warnings[0].frame, 89);
  EXPECT_THAT(asked.warnings[0].message, HasSubstr("key \"landing\" lies 0.2 m off the root path"));
  AimAt(0.92);  // within 5 cm
  EXPECT_TRUE(For(0, 90).warnings.empty());
  EXPECT_NEAR(For(0, 90).controls[kRootPath].values(0, 89), 0.92, 1e-9);
  // A key without a place contradicts no path.
  AimAt(5);
  target_->mask.root_position = false;
  EXPECT_TRUE(For(0, 90).warnings.empty());
  EXPECT_NEAR(For(0, 90).controls[kRootPath].values(0, 89), 0.89, 1e-9);
}

TEST_F(ControlTrackTest, AKeyRightAfterThePathsEndIsOffThePathAndNotTooFast) {
  track_.Set(PathRequest({0, 88}, {0, 2}), 0, "controls");
  AimAt(2.5);
  for (const int frames : {90, 91}) {
    const Asked asked = For(0, frames);
    ASSERT_EQ(asked.warnings.size(), 1u) << "a key right after the end";
    EXPECT_EQ(asked.warnings[0].code, Warning::Code::kKeyOffPath);
    EXPECT_THAT(asked.warnings[0].message, HasSubstr("key \"landing\" lies 0.4"));
    const Eigen::Matrix3Xd& path = asked.controls[kRootPath].values;
    for (int frame = 1; frame < frames; ++frame)
      EXPECT_LT(30 * (path.col(frame) - path.col(frame - 1)).norm(), 2) << frame;
  }
  // Without a key, and without time to stand up, the height does not jump.
  track_.Set(PathRequest({0, 88}, {0, 2}, {0.5, 0.5}), 0, "controls");
  target_->mask.root_position = false;
  ASSERT_EQ(For(0, 90).warnings.size(), 1u);
  EXPECT_EQ(For(0, 90).warnings[0].code, Warning::Code::kKeyOffHeight);
  target_.reset();
  EXPECT_TRUE(For(0, 90).warnings.empty());
  EXPECT_NEAR(For(0, 90).controls[kRootPath].values(1, 89), 0.5, 1e-9);
}

TEST_F(ControlTrackTest, WarnsOfATooFastPath) {
  track_.Set(PathRequest({0, 30}, {0, 3.6}), 0, "controls");  // from rest
  EXPECT_TRUE(For(0, 31).warnings.empty());
  track_.Set(PathRequest({0, 30}, {0, 6}), 0, "controls");
  const Asked asked = For(0, 31);
  ASSERT_EQ(asked.warnings.size(), 1u);
  EXPECT_EQ(asked.warnings[0].code, Warning::Code::kPathTooFast);
  EXPECT_THAT(asked.warnings[0].message, HasSubstr("m/s; people reach 5"));
}

TEST_F(ControlTrackTest, MultipliesTheReferences) {
  VelocityRequest arms;
  arms.parts = {"left_arm", "right_arm"};
  arms.factors = {2, 0.5};
  track_.Set(Velocity(arms), 0, "controls");
  // The fake model's median is 0.01 to 0.05 m a frame.
  const Eigen::Matrix<float, kBodyParts, Eigen::Dynamic> factors =
      For(0, 10).controls[kVelocityFactors].values.cast<float>();
  ASSERT_EQ(factors.cols(), 10);
  EXPECT_THAT(std::vector<float>(factors.col(9).begin(), factors.col(9).end()),
              testing::Pointwise(testing::FloatEq(), {0.01F, 0.04F, 0.015F, 0.04F, 0.05F}));
  VelocityRequest calm;
  calm.factors = {3};
  calm.reference = "calm";
  track_.Set(Velocity(calm), 5, "controls");
  EXPECT_FLOAT_EQ(For(4, 10).controls[kVelocityFactors].values(1, 9), 0.04F);
  EXPECT_FLOAT_EQ(For(5, 10).controls[kVelocityFactors].values(1, 0), 0.006F);
}

TEST_F(ControlTrackTest, InterpolatesBetweenFramesAndReplacesPartByPart) {
  VelocityRequest rising;
  rising.frames = {10, 20};
  rising.parts = {"trunk", "left_leg"};
  rising.speeds = {0.1, 0.2, 0.3, 0.2};
  track_.Set(Velocity(rising), 0, "controls");
  VelocityRequest leg;
  leg.parts = {"left_leg"};
  leg.speeds = {0};
  track_.Set(Velocity(leg), 15, "controls");
  const auto factors = For(0, 40).controls[kVelocityFactors].values;
  EXPECT_FLOAT_EQ(factors(0, 0), 0.1F);
  EXPECT_FLOAT_EQ(factors(0, 15), 0.2F);
  EXPECT_FLOAT_EQ(factors(0, 39), 0.3F);
  EXPECT_FLOAT_EQ(factors(3, 15), 0.2F);
  EXPECT_FLOAT_EQ(For(15, 25).controls[kVelocityFactors].values(3, 0), 0);
}

TEST_F(ControlTrackTest, RefusesImpossibleVelocities) {
  VelocityRequest request;
  request.factors = {-0.5};
  ExpectRefused(Velocity(request), "controls.velocity_factors.factors[0]: -0.5 is not in [0, 10]");
  request.factors = {11};
  ExpectRefused(Velocity(request), "controls.velocity_factors.factors[0]: 11 is not in [0, 10]");
  request.factors = {std::numeric_limits<double>::quiet_NaN()};
  ExpectRefused(Velocity(request), "controls.velocity_factors.factors[0]: nan is not in");
  request = {.speeds = {0.6}};
  ExpectRefused(Velocity(request),
                "controls.velocity_factors.speeds[0]: 0.6 m a frame is not in [0, 0.5]");
  request.speeds = {};
  ExpectRefused(
      Velocity(request),
      "controls.velocity_factors.factors: 0 values, but rows times columns are 1 times 1");
  request = {};
  request.frames = {0, 30, 20};
  request.factors = {1, 1, 1};
  ExpectRefused(Velocity(request),
                "controls.velocity_factors.frames[2]: 20 is not after the frame before it, 30");
  request.frames = {0, 30};
  request.parts = {"trunk", "left_arm"};
  ExpectRefused(
      Velocity(request),
      "controls.velocity_factors.factors: 3 values, but rows times columns are 2 times 2");
  request = {};
  request.factors = {1, 1};
  request.parts = {"trunk", "trunk"};
  ExpectRefused(Velocity(request), "controls.velocity_factors.parts[1]: trunk is there twice");
  request.parts = {"tail"};
  ExpectRefused(Velocity(request),
                "controls.velocity_factors.parts[0]: \"tail\" is none of trunk,");
  request = {.factors = {1}, .speeds = {0.1}};
  ExpectRefused(Velocity(request),
                "controls.velocity_factors.speeds: and factors exclude each other");
  request = {};
  request.factors = {1};
  request.reference = "frantic";
  ExpectRefused(Velocity(request),
                "controls.velocity_factors.reference: \"frantic\" is none of the model's, median, "
                "calm");
}

TEST_F(ControlTrackTest, RefusesUnsupportedControls) {
  const FakeSampler plain;
  const auto refused = [&](const ControlRequest& request, const std::string& message) {
    ExpectError(ErrorCode::kInvalidArgument, message,
                [&] { CheckControls(request, plain.model(), "controls"); });
  };
  refused(PathRequest({0, 9}, {0, 1}),
          "controls.root_path: the model \"fake\" does not have this control");
  VelocityRequest request;
  request.factors = {1};
  refused(Velocity(request),
          "controls.velocity_factors: the model \"fake\" does not have this control");
}

TEST_F(ControlTrackTest, KeepsNoMoreThanItsLimits) {
  for (size_t i = 0; i < kMaxControls; ++i) track_.Set(PathRequest({0, 1}, {0, 0}), 0, "controls");
  ExpectError(ErrorCode::kInvalidArgument, "controls[7]: is one more than the limit of 1000", [&] {
    track_.Set(PathRequest({0, 1}, {0, 0}), 0, "controls[7]");
  });
  ControlTrack other(sampler_.model());
  VelocityRequest huge;
  huge.factors.assign(kMaxControlValues + 1, 1);
  ExpectError(ErrorCode::kInvalidArgument, "1000001 points and values, the limit is 1000000",
              [&] { other.Set(Velocity(huge), 0, "controls"); });
}

}  // namespace choreo::control_track_test
