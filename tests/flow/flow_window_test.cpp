#include "model/flow/window/flow_window.h"

#include <gtest/gtest.h>

#include "model/flow/window/window_features.h"
#include "model/motion/rotation.h"
#include "tests/flow/flow_scene.h"

namespace choreo::flow_window_test {

TEST(FlowWindow, DecodingInvertsEncoding) {
  const Scene scene = MakeScene(40);
  const FlowModelParts parts = Parts();
  for (const bool keyed : {true, false}) {
    WindowRequest request = scene.request;
    if (!keyed) request.target.reset();
    const FlowWindow window(parts.prior, request);
    const auto x = window.Encode(scene.truth);
    ASSERT_TRUE(x);
    const std::vector<Pose> back = window.Decode(*x);
    for (size_t i = 0; i < back.size(); ++i) EXPECT_LT(Apart(back[i], scene.truth[i]), 1e-9);
    Eigen::MatrixXd z(x->rows(), x->cols());
    for (int d = 0; d < z.rows(); ++d)
      z.row(d) = window.Whiten(d, x->row(d).transpose()).transpose();
    EXPECT_LT((window.Colour(z) - *x).norm(), 1e-4);
  }
}

// Sums in a fixed order have the same bits on every CPU, in windows of every length.
TEST(FlowWindow, ColoursFrameByFrameInTheirOrder) {
  for (const int frames : {1, 5, 8, 13, 40, 75}) {
    const FlowWindow window(Parts().prior, MakeScene(frames).request);
    const Eigen::MatrixXd z = Eigen::MatrixXd::Random(75, frames);
    Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(75, frames);
    for (int i = 0; i < frames; ++i) {
      Eigen::MatrixXd alone = Eigen::MatrixXd::Zero(75, frames);
      alone.col(i) = z.col(i);
      sum += window.Colour(alone).cast<float>();
    }
    EXPECT_EQ(window.Colour(z).cast<float>(), sum) << frames << " frames";
  }
}

TEST(FlowWindow, MeanEndsAtTheKeyExceptWhereItsMaskIsOpen) {
  const Scene scene = MakeScene(30);
  const FlowModelParts parts = Parts();
  const auto last = [&](const WindowRequest& request) {
    const FlowWindow window(parts.prior, request);
    return window.Decode(Eigen::MatrixXd::Zero(parts.prior.dimensions(), 30)).back();
  };
  EXPECT_LT(Apart(last(scene.request), scene.request.target->pose), 2e-3);
  WindowRequest arms = scene.request;
  arms.target->mask.root_position = false;
  arms.target->mask.joints.assign(24, false);
  arms.target->mask.joints[16] = true;
  const Pose reached = last(arms);
  EXPECT_LT((reached.rotations.col(16) - scene.request.target->pose.rotations.col(16)).norm(),
            5e-3);
  EXPECT_GT((reached.rotations.col(4) - scene.request.target->pose.rotations.col(4)).norm(), 0.02);
}

// Keys too far away for their time force any speed; what follows must not be faster still.
TEST(FlowWindow, SlowsDownAfterAnImpossiblyFastHistory) {
  Scene scene = MakeScene(30);
  scene.request.target.reset();
  const auto carried = [&](double speed) {
    for (int i = 0; i < kTau; ++i)
      scene.request.history[static_cast<size_t>(i)].root_position.x() = speed * (i + 1 - kTau);
    return FlowWindow(Parts().prior, scene.request).mean()(0, 29);
  };
  const double spread = std::sqrt(1e-4);
  EXPECT_NEAR(carried(4 * spread), 2 * carried(2 * spread), 1e-9);
  EXPECT_EQ(carried(100 * spread), carried(1000 * spread));
}

TEST(FlowWindow, ReturnsToTheUsualPoseInAnyHeading) {
  Scene scene = MakeScene(30);
  const Pose rest = RestPose(Skeleton::Smpl24());
  const MotionPrior prior(Parts().prior.covariance(), {}, {rest, Eigen::VectorXd::Constant(75, 1)});
  for (Pose& pose : scene.request.history) pose = scene.request.history.back();  // stands still
  scene.request.target.reset();
  const FlowWindow window(prior, scene.request);
  const Pose& last = scene.request.history.back();
  const Pose end = window.Decode(Eigen::MatrixXd::Zero(prior.dimensions(), 30)).back();
  const double before = last.rotations.rightCols(23).norm();
  EXPECT_GT(before, 0.1);
  EXPECT_LT(end.rotations.rightCols(23).norm(), 0.99 * before);
  EXPECT_EQ(window.mean().row(4).norm(), 0);
}

// Part of the way back within a second; unless a key or a path fixes the place.
TEST(FlowWindow, ReturnsToTheStage) {
  const Scene scene = MakeScene(30);
  const MotionPrior prior(Parts().prior.covariance(), {},
                          {RestPose(Skeleton::Smpl24()), Eigen::VectorXd::Constant(75, 0.3)});
  const auto led = [&](WindowRequest request, const Eigen::Vector3d& off) {
    const auto end = [&] {
      return Eigen::Vector3d(FlowWindow(prior, request).mean().col(29).head<3>());
    };
    request.stage = GroundFrame::Of(request.history.back());
    const Eigen::Vector3d there = end();
    request.stage->origin += off;
    return Eigen::Vector3d(end() - there);
  };
  WindowRequest open = scene.request;
  open.target.reset();
  const Eigen::Vector3d back = led(open, {1, 9, -2});
  EXPECT_GT(back.x(), 0.03);
  EXPECT_LT(back.x(), 1);
  EXPECT_EQ(back.y(), 0);
  EXPECT_NEAR(back.z(), -2 * back.x(), 1e-9);
  EXPECT_EQ(led(scene.request, {1, 0, 0}).norm(), 0) << "the key says the place";
  WindowRequest arms = scene.request;
  arms.target->mask.root_position = false;
  EXPECT_GT(led(arms, {1, 0, 0}).x(), 0.03);
  open.controls[kRootPath].values = scene.request.target->pose.root_position.replicate(1, 30);
  EXPECT_EQ(led(open, {1, 0, 0}).norm(), 0) << "the path does";
}

// How far the mean's last pose is turned about the vertical.
double AboutTheVertical(const WindowRequest& request, const FlowWindow& window) {
  const Eigen::Matrix3d root = ExpMap(request.history.back().rotations.col(0));
  return window.mean().col(window.frames() - 1).segment<3>(3).dot(root.row(1).transpose());
}

// The dancer faces the audience by a window's end, as far as facing varies, by the turn nearest to
// the free one; unless a key or path says otherwise.
TEST(FlowWindow, TurnsBackToTheAudience) {
  const Scene scene = MakeScene(30);
  UsualPose usual{RestPose(Skeleton::Smpl24()), Eigen::VectorXd::Constant(75, 1)};
  const MotionPrior anywhere(Parts().prior.covariance(), {}, usual);
  usual.facing = 1e-6;
  const MotionPrior strict(Parts().prior.covariance(), {}, usual);
  usual.facing = 1.5;
  const MotionPrior loose(Parts().prior.covariance(), {}, usual);
  const auto turn = [&](const MotionPrior& prior, WindowRequest request, double front,
                        std::optional<double> own = {}) {
    request.stage = GroundFrame();
    const auto end = [&] { return AboutTheVertical(request, FlowWindow(prior, request)); };
    request.free_turn = 0;
    const double ahead = end();  // the part of the leaning that turns the dancer
    request.stage->heading = front;
    request.free_turn = own;
    return end() - ahead;
  };
  WindowRequest open = scene.request;
  open.target.reset();
  for (Pose& pose : open.history) pose = open.history.back();  // stands still
  EXPECT_NEAR(turn(strict, open, 1), 1, 1e-3);
  EXPECT_NEAR(turn(strict, open, -3), -3, 1e-3);
  EXPECT_NEAR(turn(strict, open, 1, 5), 1 + 2 * M_PI, 1e-3);
  EXPECT_NEAR(turn(strict, open, 1, -4), 1 - 2 * M_PI, 1e-3);
  EXPECT_GT(turn(loose, open, 1), 0);
  EXPECT_LT(turn(loose, open, 1), 0.9);
  EXPECT_EQ(turn(anywhere, open, 1), 0);
  EXPECT_EQ(turn(strict, scene.request, 1), turn(strict, scene.request, 2)) << "the key says it";
  WindowRequest arms = open;
  arms.target = scene.request.target;
  arms.target->mask.joints.assign(24, false);
  arms.target->mask.joints[16] = true;
  EXPECT_NEAR(turn(strict, arms, 1), 1, 1e-3);
  open.controls[kRootPath].values = scene.request.target->pose.root_position.replicate(1, 30);
  EXPECT_EQ(turn(strict, open, 1), turn(anywhere, open, 1)) << "a path leads her";
}

TEST(FlowWindow, FreeTurnIsThePriorsPrediction) {
  WindowRequest request = MakeScene(30).request;
  request.target.reset();
  const MotionPrior& prior = Parts().prior;
  const double none = FreeTurn(prior, request, 0);
  const FlowWindow window(prior, request);
  EXPECT_NEAR(none, AboutTheVertical(request, window), 1e-9);
  const double spread = (*prior.Bridges(30, 0))[MotionPrior::kTurn].spread.row(29).norm();
  EXPECT_NEAR(FreeTurn(prior, request, 2) - none, 2 * spread, 1e-9);
}

TEST(FlowWindow, RootTurnsInTheExpectedDirection) {
  const Eigen::Vector3d half(0, 3.0, 0);
  EXPECT_LT((NearerWayRound(half, {0, 1, 0}) - half).norm(), 1e-12);
  EXPECT_NEAR(NearerWayRound(half, {0, -1, 0}).y(), 3.0 - 2 * M_PI, 1e-12);
}

TEST(FlowWindow, JointPositionsMatchThePoses) {
  const Scene scene = MakeScene(30);
  const FlowModelParts parts = Parts();
  const FlowWindow window(parts.prior, scene.request);
  const Eigen::MatrixXd x = 0.3 * Eigen::MatrixXd::Random(parts.prior.dimensions(), 30);
  const Eigen::MatrixXf places = window.PlaceJoints(parts.skeleton, x);
  const std::vector<Pose> poses = window.Decode(x);
  for (int i = 0; i < 30; ++i) {
    const Eigen::Matrix3Xd at = JointPositions(parts.skeleton, poses[static_cast<size_t>(i)]);
    EXPECT_LT((places.col(i).cast<double>() - at.reshaped()).norm(), 1e-5);
  }
}

TEST(WindowRequest, MirroredTwiceIsItself) {
  WindowRequest request = MakeScene(30).request;
  request.target->mask.joints.assign(24, true);
  request.target->mask.joints[16] = false;
  request.turn_to_key = Eigen::Vector3d(0.1, 2, -0.3);
  request.controls[kRootPath].values = Eigen::Matrix3Xd::Random(3, 30);
  request.controls[kVelocityFactors].values = Eigen::MatrixXd::Random(kBodyParts, 30).cwiseAbs();
  request.controls[kVelocityFactors].requested = {true, true, false, false, true};
  request.stage = GroundFrame{{1, 0, 2}, 0.5};
  request.free_turn = 2;
  const std::vector<int> pairs = MirrorPairs(Skeleton::Smpl24());
  const WindowRequest other = Mirror(pairs, request), back = Mirror(pairs, other);
  EXPECT_FALSE(other.target->mask.joints[17]);
  EXPECT_EQ(other.stage->heading, -0.5);
  EXPECT_EQ(other.free_turn, -2);
  EXPECT_EQ(other.controls[kRootPath].values.row(0), -request.controls[kRootPath].values.row(0));
  EXPECT_EQ(other.controls[kVelocityFactors].values.row(1),
            request.controls[kVelocityFactors].values.row(2));
  EXPECT_EQ(other.controls[kVelocityFactors].requested,
            (std::vector{true, false, true, true, false}));
  EXPECT_EQ(back.target->mask.joints, request.target->mask.joints);
  EXPECT_EQ(back.controls[kVelocityFactors].values, request.controls[kVelocityFactors].values);
  EXPECT_EQ(back.controls[kRootPath].values, request.controls[kRootPath].values);
  EXPECT_EQ(*back.turn_to_key, *request.turn_to_key);
  EXPECT_EQ(back.stage->origin, request.stage->origin);
  EXPECT_EQ(back.stage->heading, request.stage->heading);
  EXPECT_EQ(Apart(back.target->pose, request.target->pose), 0);
}

TEST(WindowFeatures, BeatsHaveAPhaseAndSlowOnesAreHalved) {
  const std::vector<double> beats = {0, 10, 20};
  EXPECT_NEAR(PhaseAt(beats, 5)->phase, 0.5, 1e-12);
  EXPECT_NEAR(PhaseAt(beats, 27)->phase, 0.7, 1e-12);
  EXPECT_NEAR(PhaseAt(beats, -2)->phase, 0.8, 1e-12);
  const std::vector<double> slow = {0, 40};
  EXPECT_NEAR(PhaseAt(slow, 30)->phase, 0.5, 1e-12);
  EXPECT_NEAR(PhaseAt(slow, 30)->period, 20, 1e-12);
  EXPECT_FALSE(PhaseAt(std::vector<double>{3}, 3));
}

// A foot that a key or the floor tears away says nothing of what follows.
TEST(DescribeWindow, BoundsTheHistorysVelocities) {
  const FlowModelParts parts = Parts();
  WindowRequest request = MakeScene(30).request;
  request.history[request.history.size() - 2].rotations.col(7).x() += 1.5;
  const FlowWindow window(parts.prior, request);
  const Eigen::VectorXf whole =
      DescribeWindow(parts.skeleton, parts.config, parts.prior, request, window).whole;
  EXPECT_FLOAT_EQ(whole.cwiseAbs().maxCoeff(), MotionPrior::kMaxSpeed);
}

}  // namespace choreo::flow_window_test
