#include "model/engine/part_pace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "model/motion/skeleton.h"

namespace choreo {
namespace {

constexpr int kFrames = 90;
constexpr double kFast = 0.05;  // metres a frame

const Skeleton& Body() { return Skeleton::Smpl24(); }

// All joints swing once a second, each in a direction and at a time of its own; the root goes on.
Eigen::MatrixXd Swinging() {
  Eigen::MatrixXd positions(3 * Body().joints(), kFrames + 1);
  for (int t = 0; t <= kFrames; ++t) {
    positions.col(t).head<3>() << 0, 1, 0.01 * t;
    for (int joint = 1; joint < Body().joints(); ++joint) {
      const double phase = 0.21 * t + joint;
      positions.col(t).segment<3>(3 * joint) << 0.05 * std::sin(phase), 0.1 * joint,
          0.02 * std::cos(phase) + 0.001 * t;
    }
  }
  return positions;
}

VelocityFactorTrack FactorsOf(const Eigen::MatrixXd& positions) {
  const BodyPartWeights weights = WeighBodyParts(Body());
  VelocityFactorTrack factors(kBodyParts, positions.cols() - 1);
  for (Eigen::Index t = 0; t < factors.cols(); ++t) {
    const Eigen::Matrix3Xd before = positions.col(t).reshaped(3, Body().joints()),
                           now = positions.col(t + 1).reshaped(3, Body().joints());
    // VelocityFactors takes places in the world.
    Eigen::Matrix3Xd placed_before = before, placed = now;
    placed_before.rightCols(before.cols() - 1).colwise() += before.col(0);
    placed.rightCols(now.cols() - 1).colwise() += now.col(0);
    const auto of = VelocityFactors(weights, placed_before, placed);
    for (int part = 0; part < kBodyParts; ++part) factors(part, t) = of[part];
  }
  return factors;
}

Eigen::MatrixXd Paced(const VelocityFactorTrack& factors, bool held = true) {
  return PaceParts(WeighBodyParts(Body()), factors, Swinging(), held);
}

TEST(PaceParts, LeavesAPlanThatIsAsFastAsAsked) {
  const Eigen::MatrixXd plan = Swinging();
  EXPECT_LT((Paced(FactorsOf(plan)) - plan).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PaceParts, FollowsFactorsFrameByFrame) {
  VelocityFactorTrack wanted = FactorsOf(Swinging());
  for (int t = 0; t < kFrames; ++t)
    wanted.row(static_cast<int>(BodyPart::kLeftArm))[t] *= 1 + 0.4 * std::sin(0.5 * t);
  const VelocityFactorTrack danced = FactorsOf(Paced(wanted));
  const double before = (FactorsOf(Swinging()) - wanted).cwiseAbs().rowwise().mean().maxCoeff();
  EXPECT_LT((danced - wanted).cwiseAbs().rowwise().mean().maxCoeff(), 0.3 * before);
}

TEST(PaceParts, MakesOnePartFasterAndNoOther) {
  VelocityFactorTrack wanted = FactorsOf(Swinging());
  const auto part = static_cast<int>(BodyPart::kRightLeg);
  wanted.row(part) *= 1.5;
  const VelocityFactorTrack danced = FactorsOf(Paced(wanted)),
                            ratio = danced.array() / wanted.array();
  EXPECT_NEAR(ratio.row(part).mean(), 1, 0.05);
  for (int other = 0; other < kBodyParts; ++other) {
    if (other == part) continue;
    EXPECT_NEAR(ratio.row(other).minCoeff(), 1, 1e-6);
    EXPECT_NEAR(ratio.row(other).maxCoeff(), 1, 1e-6);
  }
}

TEST(PaceParts, KeepsThePlansRhythmUnderAConstant) {
  VelocityFactorTrack wanted = FactorsOf(Swinging());
  const auto arm = static_cast<int>(BodyPart::kLeftArm);
  const double asked = 1.4 * wanted.row(arm).mean();
  const Eigen::RowVectorXd planned = wanted.row(arm);
  wanted.row(arm).setConstant(asked);
  const Eigen::RowVectorXd danced = FactorsOf(Paced(wanted)).row(arm);
  EXPECT_NEAR(danced.mean() / asked, 1, 0.05);
  const auto swing = [](const Eigen::RowVectorXd& speeds) {
    return (speeds.array() / speeds.mean() - 1).square().mean();
  };
  EXPECT_GT(swing(danced), 0.5 * swing(planned));
}

TEST(AskAgain, AsksForMoreOfWhatIsFarTooSlow) {
  const BodyPartWeights weights = WeighBodyParts(Body());
  const VelocityFactorTrack danced = FactorsOf(Swinging());
  const auto arm = static_cast<int>(BodyPart::kLeftArm);
  for (const auto& [lack, again] :
       {std::pair(1.0, 1.0), {1.05, 1.0}, {0.95, 1.0}, {1.5, 1.36}, {0.5, 0.55}, {100.0, 2.0}}) {
    VelocityFactorTrack wanted = danced;
    wanted.row(arm).setConstant(lack * danced.row(arm).mean());
    const VelocityFactorTrack asked = AskAgain(weights, wanted, Swinging());
    EXPECT_NEAR(asked.row(arm).mean() / wanted.row(arm).mean(), again, 0.03) << lack;
    EXPECT_EQ(asked.row(0), wanted.row(0));
  }
  VelocityFactorTrack real = 3 * danced;
  for (int t = 0; t < kFrames; ++t) real(arm, t) *= 1 + 0.9 * std::sin(0.5 * t);
  EXPECT_EQ(AskAgain(weights, real, Swinging()).row(arm), real.row(arm));
}

TEST(PaceParts, KeepsTheRootAndBothEnds) {
  const Eigen::MatrixXd plan = Swinging();
  const VelocityFactorTrack twice = 2 * FactorsOf(plan);
  const Eigen::MatrixXd held = Paced(twice), free = Paced(twice, /*held=*/false);
  for (const Eigen::MatrixXd& paced : {held, free}) {
    EXPECT_EQ(paced.topRows(3), plan.topRows(3));
    EXPECT_EQ(paced.col(0), plan.col(0));
  }
  EXPECT_EQ(held.col(kFrames), plan.col(kFrames));
  EXPECT_GT((free.col(kFrames) - plan.col(kFrames)).norm(), 0.01);
}

TEST(PaceParts, HasNoJumpBetweenConstantsAndRhythms) {
  VelocityFactorTrack wanted = FactorsOf(Swinging());
  const auto arm = static_cast<int>(BodyPart::kLeftArm);
  const double level = 1.4 * wanted.row(arm).mean();
  double before = 0;
  for (const double swing : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5}) {
    for (int t = 0; t < kFrames; ++t) wanted(arm, t) = level * (1 + swing * std::sin(0.9 * t));
    const double danced = FactorsOf(Paced(wanted)).row(arm).mean() / level;
    EXPECT_NEAR(danced, 1, 0.1) << swing;
    if (before > 0) {
      EXPECT_NEAR(danced, before, 0.04) << swing;
    }
    before = danced;
  }
}

TEST(PaceParts, WantsStepsNoMoreThanThreeTimesAsLong) {
  const Eigen::MatrixXd plan = Swinging();
  const VelocityFactorTrack danced = FactorsOf(plan),
                            huge = FactorsOf(Paced(VelocityFactorTrack(100 * danced)));
  EXPECT_LT(huge.bottomRows(4).mean(), 3.05 * danced.bottomRows(4).mean());
  EXPECT_GT(huge.bottomRows(4).mean(), 2.6 * danced.bottomRows(4).mean());
}

TEST(PaceParts, LeavesWhoStandsStandingAndTakesTheShortestWays) {
  const BodyPartWeights weights = WeighBodyParts(Body());
  const Eigen::MatrixXd still = Swinging().col(0).replicate(1, 3);
  const VelocityFactorTrack fast = VelocityFactorTrack::Constant(kBodyParts, 2, kFast);
  for (const bool held : {false, true}) EXPECT_EQ(PaceParts(weights, fast, still, held), still);
  const Eigen::MatrixXd step = Swinging().leftCols(2), two = Swinging().leftCols(3);
  EXPECT_EQ(PaceParts(weights, fast.leftCols(1), step, true), step);
  EXPECT_GT((PaceParts(weights, fast.leftCols(1), step, false) - step).norm(), 0.01);
  EXPECT_TRUE(PaceParts(weights, fast, two, true).allFinite());
  EXPECT_EQ(PaceParts(weights, fast, two, true).col(2), two.col(2));
}

TEST(PaceParts, WantsStepsNoLessThanAThirdAsLong) {
  const VelocityFactorTrack danced = FactorsOf(Swinging()),
                            slow = FactorsOf(Paced(VelocityFactorTrack(0 * danced)));
  EXPECT_LT(slow.bottomRows(4).mean(), 0.45 * danced.bottomRows(4).mean());
  EXPECT_GT(slow.bottomRows(4).mean(), 0.3 * danced.bottomRows(4).mean());
}

}  // namespace
}  // namespace choreo
