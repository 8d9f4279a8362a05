#include "model/training/windows/window_clips.h"

#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>

#include "model/motion/kinematics/kinematics.h"
#include "model/motion/kinematics/mirror.h"
#include "model/training/clips/clip_statistics.h"
#include "model/training/flow_matching/flow_statistics.h"
#include "model/training/windows/window_body.h"
#include "tests/support/synthetic_clips.h"

namespace choreo::window_clips_test {

using testing_support::SyntheticClip;
using torch::Tensor;

constexpr int kFrames = 20;

class WindowClipsTest : public testing::Test {
 protected:
  WindowClipsTest()
      : clips_({SyntheticClip("a", 200, 0, false), SyntheticClip("b", 200, 1, false)}) {}

  FlowModelParts Parts() const {
    ContinuousFlowConfig config;
    config.median_factors = MedianFactors(clips_.tracks());
    VariancePowers powers{.medians = config.median_factors};
    powers.parts.assign(static_cast<size_t>(3 + 3 * clips_.skeleton().joints()), 0);
    return {clips_.skeleton(),
            config,
            MotionPrior(VelocityCovariance(clips_.skeleton(), clips_.tracks(), 60), powers,
                        MeasureUsualPose(clips_.skeleton(), clips_.tracks())),
            {}};
  }
  WindowBatch Draw(const WindowClips::Variation& variation) const {
    Random random(4);
    return clips_.Draw(Parts(), 3, kFrames, kFrames, variation, &random);
  }
  // Coordinates [batch, w, dimensions] of the real motion.
  Tensor Coordinates(const WindowBatch& batch) const {
    const FlowModelParts parts = Parts();
    std::vector<Tensor> x;
    for (size_t i = 0; i < batch.truth.size(); ++i) {
      const Eigen::MatrixXf own =
          FlowWindow(parts.prior, batch.requests[i]).Encode(batch.truth[i])->cast<float>();
      x.push_back(
          torch::from_blob(const_cast<float*>(own.data()), {own.cols(), own.rows()}).clone());
    }
    return torch::stack(x);
  }

  static PreparedClip FastClip() {
    PreparedClip clip = SyntheticClip("fast", 800, 0, false);
    std::vector<Pose> fast;
    for (size_t i = 0; i < clip.motion.frames.size(); i += 2) fast.push_back(clip.motion.frames[i]);
    clip.motion.frames = fast;
    return clip;
  }

  WindowClips clips_;
};

TEST_F(WindowClipsTest, BodyAgreesWithForwardKinematics) {
  const WindowBatch batch = Draw({});
  const WindowBody body(clips_.skeleton(), torch::kCPU);
  const Tensor places = body.Place(batch, Coordinates(batch));
  for (size_t i = 0; i < batch.truth.size(); ++i) {
    for (int t = 0; t < kFrames; ++t) {
      const Eigen::Matrix3Xd expected =
          JointPositions(clips_.skeleton(), batch.truth[i][static_cast<size_t>(t)]);
      const Tensor row = places[static_cast<int64_t>(i)][t].contiguous();
      const Eigen::Map<const Eigen::Matrix3Xf> own(row.data_ptr<float>(), 3, expected.cols());
      EXPECT_LT((own.cast<double>() - expected).cwiseAbs().maxCoeff(), 1e-5);
    }
  }
}

// The mean of a pose and its mirror image is its own mirror image; the position of clips does not
// matter.
TEST_F(WindowClipsTest, UsualPoseIsSymmetric) {
  const UsualPose usual = MeasureUsualPose(clips_.skeleton(), clips_.tracks());
  const Pose mirrored = Mirror(clips_.skeleton(), usual.pose);
  EXPECT_LT((mirrored.rotations - usual.pose.rotations).norm(), 1e-9);
  EXPECT_EQ(usual.pose.root_position.x(), 0);
  EXPECT_GT(usual.pose.root_position.y(), 0.5);
  EXPECT_GT(usual.variance.minCoeff(), -1e-12);
  std::vector<ClipTrack> elsewhere(clips_.tracks().begin(), clips_.tracks().end());
  for (ClipTrack& track : elsewhere) {
    track.stage.origin.x() += 7;
    for (Pose& pose : track.poses) pose.root_position.x() += 7;
  }
  const UsualPose there = MeasureUsualPose(clips_.skeleton(), elsewhere);
  EXPECT_LT((there.variance - usual.variance).norm(), 1e-9);
}

// Clips that are turned have their audience elsewhere, and face it as well.
TEST_F(WindowClipsTest, FacingVariesAboutTheAudience) {
  const UsualPose usual = MeasureUsualPose(clips_.skeleton(), clips_.tracks());
  EXPECT_GT(usual.facing, 0);
  std::vector<ClipTrack> turned(clips_.tracks().begin(), clips_.tracks().end());
  for (ClipTrack& track : turned) {
    for (Pose& pose : track.poses) pose = GroundFrame{{0, 0, 0}, 2}.ToWorld(pose);
    track.stage.heading = MeanFacing(track.poses);
  }
  EXPECT_NEAR(MeasureUsualPose(clips_.skeleton(), turned).facing, usual.facing, 1e-9);
  for (ClipTrack& track : turned) track.stage.heading += 1;
  EXPECT_GT(MeasureUsualPose(clips_.skeleton(), turned).facing, usual.facing + 0.5);
}

// Without a known stage there is no usual place. A batch marks the windows that have one.
TEST_F(WindowClipsTest, StagesAreGivenAtTheRequestedRate) {
  EXPECT_EQ(Draw({.no_key = 1}).staged.sum().item<double>(), 0);
  EXPECT_EQ(Draw({.no_key = 1, .stage = 1}).staged.sum().item<double>(), 3);
  EXPECT_EQ(Draw({.stage = 1}).staged.sum().item<double>(), 0) << "keys say the place";
}

TEST_F(WindowClipsTest, BodyVelocitiesMatchCoordinates) {
  const WindowBatch batch = Draw({.no_key = 1});  // far from the mean
  const WindowBody body(clips_.skeleton(), torch::kCPU);
  const Tensor x = Coordinates(batch);
  EXPECT_GT(x.abs().max().item<double>(), 0.1);
  torch::manual_seed(3);
  const Tensor dx = 1e-3 * torch::randn(x.sizes());
  const Tensor moved = body.Move(batch, dx).flatten(2);
  const Tensor seen = 0.5 * (body.Place(batch, x + dx) - body.Place(batch, x - dx));
  EXPECT_GT(moved.abs().max().item<double>(), 1e-3);
  EXPECT_LT((moved - seen).abs().max().item<double>(), 2e-5);
}

TEST_F(WindowClipsTest, PerturbedHistoryReturnsToTheRecording) {
  const WindowBatch real = Draw({}), astray = Draw({.astray = 1});
  // The first window is the same; the dancer ends in the same pose, except for the initial heading.
  const auto apart = [](const Pose& a, const Pose& b) {
    return (a.rotations - b.rotations).rightCols(a.rotations.cols() - 1).norm();
  };
  EXPECT_LT(apart(real.truth[0].back(), astray.truth[0].back()), 1e-9);
  EXPECT_LT(apart(real.requests[0].target->pose, astray.requests[0].target->pose), 1e-9);
  const double before = apart(real.requests[0].history.back(), astray.requests[0].history.back());
  EXPECT_GT(before, 1e-3);
  EXPECT_LT(apart(real.truth[0][12], astray.truth[0][12]), before);
}

TEST_F(WindowClipsTest, WindowsBeginStandingAsDancesDo) {
  const WindowBatch real = Draw({}), standing = Draw({.standing = 1});
  const auto apart = [](const Pose& a, const Pose& b) {
    return (a.rotations - b.rotations).rightCols(a.rotations.cols() - 1).norm();
  };
  const Pose stance = StandingPose(clips_.skeleton());
  for (const Pose& pose : standing.requests[0].history) {
    EXPECT_LT(apart(pose, stance), 1e-9);
    EXPECT_NEAR(pose.root_position.y(), stance.root_position.y(), 1e-9);
  }
  EXPECT_LT(apart(real.truth[0].back(), standing.truth[0].back()), 1e-9);
  EXPECT_LT(apart(standing.truth[0].front(), stance), apart(real.truth[0].front(), stance));
}

TEST_F(WindowClipsTest, EnergyPredictsTheSpread) {
  std::vector<WindowBatch> batches;
  for (uint32_t i = 0; i < 8; ++i) {
    Random random(4, i);
    batches.push_back(
        clips_.Draw(Parts(), 8, kFrames, kFrames, {.tempo = 0.8, .energy = 1}, &random));
  }
  const VariancePowers measured = MeasureVariancePowers(Parts().prior, batches);
  EXPECT_GT(measured.level, 0);
  VariancePowers powers = Parts().prior.powers();
  powers.level = 1;
  const MotionPrior prior(Parts().prior.covariance(), powers);
  Eigen::MatrixXd levels = Eigen::MatrixXd::Constant(kBodyParts, 3, NAN);
  EXPECT_TRUE(prior.Scales(1, levels).isOnes(0)) << "nothing is known";
  levels.leftCols<2>() << Eigen::MatrixXd::Constant(kBodyParts, 1, -1),
      Eigen::MatrixXd::Constant(kBodyParts, 1, 1);
  const Eigen::MatrixXd scales = prior.Scales(1, levels);
  EXPECT_LT(scales(3, 0), 1);
  EXPECT_GT(scales(3, 1), 1);
  EXPECT_EQ(scales(3, 2), 1);
}

TEST_F(WindowClipsTest, MeasuresEnergyCurvesOfTheClips) {
  // A dancer whose arms and trunk are alternately fast and slow, a second each.
  ClipTrack track;
  track.energy = Eigen::MatrixXd::Constant(kBodyParts, 600, 0.01);
  for (Eigen::Index i = 0; i < track.energy.cols(); ++i)
    track.energy.col(i).head<3>() *= i / 30 % 2 == 0 ? 0.5 : 2;
  std::array<double, kBodyParts> medians;
  medians.fill(0.01);
  const EnergyCurve curve = MeasureCurve(std::array{track}, medians);
  ASSERT_TRUE(curve.known());
  EXPECT_EQ(curve.correlation[0], 1);
  EXPECT_GT(curve.correlation[5], 0.5);
  EXPECT_LT(curve.correlation[30], -0.5);
  const Eigen::MatrixXd covariance = curve.spread * curve.spread.transpose();
  EXPECT_GT(covariance(0, 1), 0.9 * covariance(0, 0)) << "both go up at once";
  EXPECT_LT(covariance(3, 3), 1e-5) << "the legs go on alike";
  track.energy = track.energy.leftCols(50).eval();
  EXPECT_FALSE(MeasureCurve(std::array{track}, medians).known()) << "too short a clip";
}

// Has learnt nothing: its dances are the prior's.
class Silent : public FlowNetwork {
 public:
  Eigen::MatrixXf Condition(const Eigen::VectorXf& whole,
                            std::span<const float> times) const override {
    return whole.replicate(1, std::ssize(times));
  }
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf&, const Eigen::MatrixXf&,
                           const Eigen::MatrixXf&, const Eigen::MatrixXf&,
                           const Eigen::VectorXf&) const override {
    return Eigen::MatrixXf::Zero(z.rows(), z.cols());
  }
};

TEST_F(WindowClipsTest, RequestedEnergyEqualsRecordedEnergy) {
  const WindowClips clips({SyntheticClip("calm", 400, 0, false), FastClip()});
  FlowModelParts parts = Parts();
  parts.config.median_factors = MedianFactors(clips.tracks());
  parts.mixing.setIdentity(parts.prior.dimensions(), parts.prior.dimensions());
  std::vector<WindowRequest> requests;
  for (uint32_t i = 0; i < 2; ++i) {
    Random random(4, i);
    const WindowBatch batch =
        clips.Draw(parts, 64, kFrames, kFrames, {.no_key = 1, .energy = 1}, &random);
    requests.insert(requests.end(), batch.requests.begin(), batch.requests.end());
  }
  for (WindowRequest& request : requests)
    request.controls[kVelocityFactors].requested.assign(kBodyParts, true);
  const EnergyResponse honest = MeasureResponse(parts, Silent(), requests);
  ASSERT_TRUE(honest.known());
  // Twice the requested energy does not change the dance: the response is lower by as much.
  for (WindowRequest& request : requests) request.controls[kVelocityFactors].values *= 2;
  const EnergyResponse doubled = MeasureResponse(parts, Silent(), requests);
  EXPECT_NEAR(doubled.slope[0], honest.slope[0], 0.05);
  EXPECT_NEAR(doubled.offset[0], honest.offset[0] - honest.slope[0] * std::log(2), 0.1);
  EXPECT_FALSE(MeasureResponse(parts, Silent(), {}).known()) << "of nothing";
}

TEST_F(WindowClipsTest, EnergyPersists) {
  // One dances twice as fast as the other.
  const WindowClips clips({SyntheticClip("calm", 400, 0, false), FastClip()});
  FlowModelParts parts = Parts();
  parts.config.median_factors = MedianFactors(clips.tracks());
  std::vector<WindowRequest> requests;
  for (uint32_t i = 0; i < 6; ++i) {
    Random random(4, i);
    const WindowBatch batch = clips.Draw(parts, 64, kFrames, kFrames,
                                         {.no_key = i % 2 == 0 ? 1.0 : 0.0, .energy = 1}, &random);
    requests.insert(requests.end(), batch.requests.begin(), batch.requests.end());
  }
  const EnergyPrior measured = MeasureEnergy(parts, requests);
  const auto trunk = [&](bool keyed, double history) {
    return measured.Sample(
        {.key = keyed, .history = EnergyPrior::Levels::Constant(history), .frames = kFrames},
        EnergyPrior::Levels::Zero())[0];
  };
  EXPECT_LT(trunk(true, -0.4) + 0.1, trunk(true, 0.4));
  EXPECT_EQ(trunk(false, -0.4), trunk(false, 0.4)) << "it would fade or rage";
}

TEST_F(WindowClipsTest, RareStylesAreDrawnAsOftenOnRequest) {
  const WindowClips clips(
      {SyntheticClip("salsa_1", 900, 0, false), SyntheticClip("indian_1", 100, 1, false)});
  FlowModelParts parts = Parts();
  parts.config.styles = clips.styles();
  const auto indian = [&](double even_styles) {
    Random random(4);
    const WindowBatch batch =
        clips.Draw(parts, 100, kFrames, kFrames, {.style = 1, .even_styles = even_styles}, &random);
    return std::ranges::count(batch.requests, 0, &WindowRequest::style);
  };
  EXPECT_LT(indian(0), 20);
  EXPECT_GT(indian(1), 35);
  EXPECT_LT(indian(1), 65);
}

}  // namespace choreo::window_clips_test
