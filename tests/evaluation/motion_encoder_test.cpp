#include "model/evaluation/judges/motion_encoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/evaluation/evaluation.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"
#include "tests/support/fake_sampler.h"
#include "tests/support/synthetic_clips.h"

namespace choreo::motion_encoder_test {

using testing_support::SyntheticClip;

ClipSet Clips(int frames) {
  return {"set",
          {SyntheticClip("a_1", frames, 0.1, false), SyntheticClip("b_1", frames, 2.1, false)}};
}

TEST(MotionEncoder, ItsCodesAreUncorrelatedAndOfUnitVarianceInTraining) {
  const ClipSet set = Clips(600);
  const MotionEncoder encoder({set});
  Eigen::MatrixXd codes(0, 0);
  for (const PreparedClip& clip : set.clips) {
    const Eigen::MatrixXd some = encoder.Encode(clip.skeleton, clip.motion.frames);
    EXPECT_EQ(some.cols(), 1 + (600 - 30) / 10);
    const Eigen::Index before = codes.cols();
    codes.conservativeResize(some.rows(), before + some.cols());
    codes.rightCols(some.cols()) = some;
  }
  EXPECT_LT(codes.rowwise().mean().norm(), 1e-6);
  const Eigen::MatrixXd covariance = codes * codes.transpose() / static_cast<double>(codes.cols());
  EXPECT_LT((covariance - Eigen::MatrixXd::Identity(codes.rows(), codes.rows())).norm(), 1e-4);
  EXPECT_GT(encoder.explained(), 0.95);
}

TEST(MotionEncoder, DoesNotDependOnPlaceOrHeading) {
  const ClipSet set = Clips(300);
  const MotionEncoder encoder({set});
  std::vector<Pose> moved = set.clips[0].motion.frames;
  const GroundFrame elsewhere{{2, 0, -1}, 0.8};
  for (Pose& pose : moved) pose = elsewhere.ToWorld(pose);
  const Skeleton& skeleton = set.clips[0].skeleton;
  EXPECT_LT((encoder.Encode(skeleton, moved) - encoder.Encode(skeleton, set.clips[0].motion.frames))
                .cwiseAbs()
                .maxCoeff(),
            1e-3);
}

TEST(MotionEncoder, HashesItsDataAndNeedsSome) {
  const std::string version = MotionEncoder({Clips(300)}).version();
  EXPECT_THAT(version, testing::MatchesRegex("linear-1/[0-9a-f]{16}"));
  EXPECT_EQ(MotionEncoder({Clips(300)}).version(), version);
  EXPECT_NE(MotionEncoder({Clips(310)}).version(), version);
  ClipSet touched = Clips(300);  // one joint of one frame
  touched.clips[1].motion.frames[77].rotations(0, 3) += 1e-3;
  EXPECT_NE(MotionEncoder({touched}).version(), version);
  ExpectError(ErrorCode::kInvalidArgument, "0 windows", [] { MotionEncoder({Clips(20)}); });
}

TEST(MeanApart, HasKnownValues) {
  // Codes of two windows; the third dance has but one, which is compared alone.
  Eigen::MatrixXd a(2, 2), b(2, 2), c(2, 1);
  a << 0, 0, 0, 0;
  b << 3, 1, 4, 0;  // windows (3, 4) and (1, 0): 25 and 1 from a's
  c << 0, 2;        // 4 from a's, 9 + 4 from b's
  EXPECT_DOUBLE_EQ(MeanApart({a, b}), 13);
  EXPECT_DOUBLE_EQ(MeanApart({a, b, c}), (13.0 + 4 + 13) / 3);
  EXPECT_EQ(MeanApart({a}), 0);
}

TEST(EvaluateEncoded, RealMotionIsNearestAndSeedsVaryOnlyWithNoise) {
  const ClipSet set = Clips(600);
  const MotionEncoder encoder({set});
  FakeSampler sampler;
  const std::vector<Method> methods = {{"real", Method::Kind::kReal},
                                       {"free", Method::Kind::kModel, &sampler, false},
                                       {"model", Method::Kind::kModel, &sampler}};
  EvalOptions options{.temperature = 0.5F, .long_frames = 120};
  const Runner runner;
  const Evaluation evaluation{set, methods, options, runner, &encoder};
  const Table table = EvaluateEncoded(evaluation).front();
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_LT(table.rows[0].cells[0].value, table.rows[1].cells[0].value);
  EXPECT_GT(table.rows[1].cells[1].value, 0);
  EXPECT_GT(table.rows[2].cells[2].value, table.rows[2].cells[1].value);
  options.temperature = 0;
  EXPECT_EQ(EvaluateEncoded(evaluation).front().rows[2].cells[1].value, 0);
}

}  // namespace choreo::motion_encoder_test
