#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "model/core/numbers/random.h"
#include "model/metrics/frechet.h"
#include "model/metrics/motion_features.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/support/expect_error.h"

namespace choreo::dance_features_test {

const Skeleton& Body() { return Skeleton::Smpl24(); }

TEST(Frechet, DistanceOfKnownGaussians) {
  // Two points per axis: mean and covariance are exact. C = diag(2, 2) against diag(8, 2).
  Eigen::MatrixXd a(2, 4), b(2, 4);
  a << -1, 1, -1, 1, -1, -1, 1, 1;
  b << -2, 2, -2, 2, -1, -1, 1, 1;
  const double scale = 4.0 / 3;  // unbiased covariance of four points
  EXPECT_NEAR(FrechetDistance(a, b), scale * (1 + 4 - 2 * 2), 1e-9);
  EXPECT_NEAR(FrechetDistance(a, a), 0, 1e-9);
  const Eigen::MatrixXd moved = a.colwise() + Eigen::Vector2d(3, 4);
  EXPECT_NEAR(FrechetDistance(a, moved), 25, 1e-9);
  ExpectError(ErrorCode::kInvalidArgument, "1 motions", [&] { FrechetDistance(a, b.leftCols(1)); });
}

TEST(Frechet, DistanceOfGaussiansThatAreDrawn) {
  // N((0, 0), [2 1; 1 2]) and N((1, -2), [5 3; 3 5]) have the eigenvectors (1, 1), (1, -1) in
  // common, and the variances 3, 1 and 8, 2 along them, so the distance has a closed form.
  const double expected =
      1 + 4 + std::pow(std::sqrt(3) - std::sqrt(8), 2) + std::pow(1 - std::sqrt(2), 2);
  Random random(7);
  const auto draw = [&](const Eigen::Vector2d& mean, double sum, double difference) {
    Eigen::MatrixXd set(2, 20000);
    for (Eigen::Index i = 0; i < set.cols(); ++i) {
      const double along = std::sqrt(sum / 2) * random.Normal();
      const double across = std::sqrt(difference / 2) * random.Normal();
      set.col(i) = mean + Eigen::Vector2d(along + across, along - across);
    }
    return set;
  };
  EXPECT_NEAR(FrechetDistance(draw({0, 0}, 3, 1), draw({1, -2}, 8, 2)), expected, 0.03 * expected);
}

TEST(Frechet, DoesNotDependOnTheBasis) {
  Random random(1);
  Eigen::MatrixXd a(3, 40), b(3, 40);
  for (double& value : a.reshaped()) value = random.Normal();
  for (double& value : b.reshaped()) value = 0.3 + 2 * random.Normal();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_NEAR(FrechetDistance(a, b), FrechetDistance(turn * a, turn * b), 1e-9);
  EXPECT_NEAR(FrechetDistance(a, b), FrechetDistance(b, a), 1e-9);
}

TEST(Frechet, PairDistances) {
  Eigen::MatrixXd points(1, 3);
  points << 0, 1, 3;
  EXPECT_DOUBLE_EQ(MeanPairDistance(points), (1 + 2 + 3) / 3.0);
  EXPECT_EQ(MeanPairDistance(points.leftCols(1)), 0);
}

TEST(Frechet, ScaleMakesRealFeaturesStandard) {
  Eigen::MatrixXd real(2, 3);
  real << 1, 2, 3, 5, 5, 5;
  const Eigen::MatrixXd scaled = FeatureScale::Of(real).Apply(real);
  EXPECT_NEAR(scaled(0, 0), -1, 1e-12);
  EXPECT_NEAR(scaled(0, 2), 1, 1e-12);
  EXPECT_NEAR(scaled.row(1).norm(), 0, 1e-12);  // constant features stay as they are
}

TEST(KineticFeatures, OfSteadyMotion) {
  JointTrack track;
  for (int t = 0; t < 12; ++t) {
    track.push_back(JointPositions(Body(), RestPose(Body())).colwise() +
                    Eigen::Vector3d(3, 2, 4) * (t / 30.0));
  }
  const Eigen::VectorXd features = KineticFeatures(track, 30);
  ASSERT_EQ(features.size(), 3 * Body().joints());
  for (int joint = 0; joint < Body().joints(); ++joint) {
    EXPECT_NEAR(features[3 * joint], 25, 1e-6);     // horizontal
    EXPECT_NEAR(features[3 * joint + 1], 4, 1e-6);  // vertical
    EXPECT_NEAR(features[3 * joint + 2], 0, 1e-6);  // no acceleration
  }
}

TEST(KineticFeatures, OfFreeFall) {
  JointTrack track;
  for (int t = 0; t < 12; ++t) {
    Eigen::Matrix3Xd joints = Eigen::Matrix3Xd::Zero(3, 1);
    joints(1, 0) = -0.5 * 9.81 * t * t / 900;
    track.push_back(joints);
  }
  EXPECT_NEAR(KineticFeatures(track, 30)[2], 9.81, 1e-6);
}

// Indices into GeometricFeatures.
enum { kRightHandFast = 12, kLeftHandFast = 13, kLeftFootRaised = 17, kRightKneeBent = 19 };
enum { kLeftKneeBent = 20, kLeftThigh = 26, kTrunkLevel = 28, kRootFast = 31 };

Eigen::VectorXd OfPoses(const std::vector<Pose>& poses) {
  return GeometricFeatures(Body(), TrackJoints(Body(), poses), 30);
}

TEST(GeometricFeatures, OfARaisedLeg) {
  std::vector<Pose> poses(20, RestPose(Body()));
  const Eigen::VectorXd standing = OfPoses(poses);
  EXPECT_EQ(standing[kLeftFootRaised], 0);
  EXPECT_EQ(standing[kLeftKneeBent], 0);
  EXPECT_EQ(standing[kTrunkLevel], 0);
  for (size_t t = 0; t < 20; ++t) {
    poses[t].rotations(0, Body().left_hip) = -1.6;
    poses[t].rotations(0, Body().left_knee) = 1.7;
  }
  const Eigen::VectorXd raised = OfPoses(poses);
  EXPECT_EQ(raised[kLeftFootRaised], 1);
  EXPECT_EQ(raised[kLeftKneeBent], 1);
  EXPECT_EQ(raised[kRightKneeBent], 0);
  EXPECT_EQ(raised[kLeftThigh], 1);
}

TEST(GeometricFeatures, OfASpeedAndOfABow) {
  std::vector<Pose> poses(20, RestPose(Body()));
  for (size_t t = 0; t < 20; ++t) poses[t].root_position.x() = 2.0 * static_cast<double>(t) / 30;
  const Eigen::VectorXd running = OfPoses(poses);
  EXPECT_EQ(running[kRootFast], 1);
  EXPECT_EQ(running[kRightHandFast], 1);
  EXPECT_EQ(running[kLeftHandFast], 1);
  for (Pose& pose : poses) pose.rotations(0, 0) = 1.57;
  EXPECT_EQ(OfPoses(poses)[kTrunkLevel], 1);
}

TEST(GeometricFeatures, DoNotDependOnWhereTheDancerStandsOrFaces) {
  std::vector<Pose> poses(30, RestPose(Body()));
  for (size_t t = 0; t < 30; ++t) {
    for (int joint = 1; joint < Body().joints(); ++joint) {
      poses[t].rotations(joint % 3, joint) = 0.8 * std::sin(0.3 * static_cast<double>(t) + joint);
    }
  }
  const Eigen::VectorXd here = OfPoses(poses);
  EXPECT_GT(here.sum(), 2);
  for (Pose& pose : poses) {
    pose.root_position += Eigen::Vector3d(2, 0, -1);
    pose.rotations.col(0) = Eigen::Vector3d(0, 1.2, 0);
  }
  EXPECT_LT((OfPoses(poses) - here).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace choreo::dance_features_test
