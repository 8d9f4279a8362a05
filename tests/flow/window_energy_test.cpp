#include "model/flow/window/window_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/motion/rotation.h"
#include "tests/flow/flow_networks.h"

namespace choreo::window_energy_test {

// Records the energy given to the network.
class Listening : public Silent {
 public:
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                           const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                           const Eigen::MatrixXf& frames,
                           const Eigen::VectorXf& condition) const override {
    told = frames.rightCols(1);
    all = frames.rightCols(z.cols());
    return Silent::Evaluate(z, poses, joints, mean, frames, condition);
  }
  mutable Eigen::VectorXf told;
  mutable Eigen::MatrixXf all;
};

TEST(FlowSampler, SamplesOnlyEnergyThatIsNotRequested) {
  const Scene scene = MakeScene(30);
  FlowModelParts parts = Parts();
  parts.config.median_factors.fill(0.01);
  parts.energy.spread.setIdentity();
  const Listening network;
  const auto told = [&](const WindowRequest& request, uint64_t seed) {
    Window(parts, network, request, {.seed = seed, .temperature = 1});
    return network.told;
  };
  EXPECT_EQ(told(scene.request, 1), told(scene.request, 1));
  const Eigen::VectorXf differ = told(scene.request, 1) - told(scene.request, 2);
  EXPECT_EQ((differ.array() != 0).count(), kBodyParts);
  WindowRequest arm = scene.request;
  arm.controls[kVelocityFactors].values = Eigen::MatrixXd::Constant(kBodyParts, 30, 0.03);
  arm.controls[kVelocityFactors].requested = {false, true, false, false, false};
  const Eigen::VectorXf of_others = told(arm, 1) - told(arm, 2);
  EXPECT_EQ((of_others.array() != 0).count(), kBodyParts - 1);
  EXPECT_EQ(((told(arm, 1) - told(scene.request, 1)).array() != 0).count(), 1);
}

// Levels per frame, whose energy averages to the window's.
TEST(FlowSampler, EnergyCurveVariesAroundTheWindowsEnergy) {
  const Scene scene = MakeScene(30);
  FlowModelParts parts = Parts();
  parts.config.median_factors.fill(0.01);
  const Listening network;
  const auto levels = [&](uint64_t seed, double temperature) {
    Window(parts, network, scene.request, {.seed = seed, .temperature = temperature});
    const Eigen::VectorXf last = network.told;
    return std::pair(last, network.all);
  };
  const auto [constant, of_all] = levels(1, 1);
  for (parts.curve.correlation.setZero(); const int lag : {0, 1, 2})
    parts.curve.correlation[lag] = 1 - lag / 3.0;
  parts.curve.spread = 0.5 * Eigen::MatrixXd::Identity(kBodyParts, kBodyParts);
  const auto [one, all] = levels(1, 1);
  const auto [other, others] = levels(2, 1);
  EXPECT_NE(one, other);
  EXPECT_EQ(levels(1, 0).second, levels(2, 0).second) << "the mean way is nobody's luck";
  int moving = 0;
  for (Eigen::Index row = 0; row < all.rows(); ++row) {
    if (all.row(row) == of_all.row(row)) continue;
    ++moving;
    // Levels are logarithms with a millimetre a frame added.
    const Eigen::ArrayXd energy = 0.011 * all.row(row).transpose().array().cast<double>().exp();
    EXPECT_NEAR(energy.mean(), 0.011, 1e-6);
    EXPECT_GT((energy - energy.mean()).abs().maxCoeff(), 2e-3);
  }
  EXPECT_EQ(moving, kBodyParts);
}

TEST(FlowSampler, RequestedEnergyIsCorrectedByTheResponse) {
  Scene scene = MakeScene(30);
  FlowModelParts parts = Parts();
  parts.config.median_factors.fill(0.01);
  scene.request.controls[kVelocityFactors].values = Eigen::MatrixXd::Constant(kBodyParts, 30, 0.03);
  const Listening network;
  const auto told = [&] {
    Window(parts, network, scene.request, {.temperature = 1});
    return network.told;
  };
  const Eigen::VectorXf plain = told();
  parts.response.offset.setConstant(0.1);
  parts.response.slope.setConstant(0.5);
  const Eigen::VectorXf more = told() - plain;
  const double wanted = std::log(0.031 / 0.011);
  EXPECT_EQ((more.array() != 0).count(), kBodyParts);
  EXPECT_NEAR(more.maxCoeff(), (wanted - 0.1) / 0.5 - wanted, 1e-5);
  parts.energy.most.setConstant(wanted + 0.1);
  EXPECT_NEAR((told() - plain).maxCoeff(), 0.1, 1e-5) << "as lively as training saw";
}

TEST(FlowSampler, MusicShiftsOnlySampledEnergyAndOnce) {
  const Scene scene = MakeScene(30);
  FlowModelParts parts = Parts();
  parts.config.median_factors.fill(0.01);
  const Listening network;
  const auto told = [&](const WindowRequest& request) {
    Window(parts, network, request, {.temperature = 1});
    return network.told;
  };
  WindowRequest arm = scene.request;
  arm.controls[kVelocityFactors].values = Eigen::MatrixXd::Constant(kBodyParts, 30, 0.03);
  arm.controls[kVelocityFactors].requested = {false, true, false, false, false};
  const Eigen::VectorXf calm = told(arm);
  arm.energy_shift.now = 0.5;
  const Eigen::VectorXf shifted = told(arm) - calm;
  EXPECT_EQ((shifted.array() != 0).count(), kBodyParts - 1);
  EXPECT_NEAR(shifted.maxCoeff(), 0.5, 1e-5);
  // A history with energy from the music is continued as if the music had not changed it.
  for (int part = 0; part < kBodyParts; ++part)
    parts.energy.keyed(part, EnergyPrior::kHistoryInput + part) = 0.5;
  const Eigen::VectorXf follows = told(arm);
  arm.energy_shift.before = 0.5;
  EXPECT_NEAR((told(arm) - follows).minCoeff(), -0.25, 1e-5);
}

// Beyond it networks answer with anything: dancers flew off the stage.
TEST(FlowSampler, MusicAsksForNoMoreEnergyThanTrainingHad) {
  Scene scene = MakeScene(30);
  FlowModelParts parts = Parts();
  parts.config.median_factors.fill(0.01);
  parts.curve.correlation[0] = 1;
  parts.curve.spread = 0.5 * Eigen::MatrixXd::Identity(kBodyParts, kBodyParts);
  const Listening network;
  const auto told = [&](double shift) {
    scene.request.energy_shift.now = shift;
    Window(parts, network, scene.request, {.seed = 3, .temperature = 1});
    return network.all;
  };
  const Eigen::MatrixXf calm = told(0);
  parts.energy.most.setConstant(0.4);
  // Rows that differ are levels of energy.
  const Eigen::MatrixXf loud = told(3);
  int rows = 0;
  for (Eigen::Index row = 0; row < loud.rows(); ++row) {
    if (loud.row(row) == calm.row(row)) continue;
    ++rows;
    EXPECT_LE(loud.row(row).maxCoeff(), 0.4F + 1e-5F);
    EXPECT_GT(loud.row(row).maxCoeff(), 0.39F);
  }
  EXPECT_EQ(rows, kBodyParts);
}

TEST(FlowSampler, LaterWindowsStartFromTheFirstsEnergyShift) {
  WindowRequest request = MakeScene(30).request;
  request.energy_shift = {.before = 0.1, .now = 0.7};
  const GroundFrame ground = GroundFrame::Of(request.history.back());
  EXPECT_EQ(request.Part(0, 10, request.history, ground).energy_shift.before, 0.1);
  EXPECT_EQ(request.Part(10, 10, request.history, ground).energy_shift.before, 0.7);
}

// Each is decided by a random number of its own.
TEST(FlowSampler, TheWayRoundToAKeyTellsNothingOfTheTrunksEnergy) {
  Scene scene = MakeScene(10);
  const Pose& last = scene.request.history.back();
  scene.request.target = Target{last, {}};
  scene.request.target->pose.rotations.col(0) =
      LogMap(ExpMap(std::numbers::pi * 0.98 * UpOf(last)) * ExpMap(last.rotations.col(0)));
  FlowModelParts parts = Parts();
  parts.config.median_factors.fill(0.01);
  parts.curve.correlation[0] = 1;
  parts.curve.spread = 0.5 * Eigen::MatrixXd::Identity(kBodyParts, kBodyParts);
  parts.turns.weights[0] = 1e-9;  // dancers turn either way as often
  const Listening network;
  constexpr int kFirstControl = 7, kPathFeatures = 5;  // window_features.cpp
  constexpr int kSeeds = 100;
  double turns = 0, together = 0, energy = 0, square = 0;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Pose> poses =
        Transition(parts, network, scene.request, {.seed = seed, .temperature = 1});
    const Eigen::Vector3d half =
        RotationDifference(last.rotations.col(0), poses[poses.size() / 2].rotations.col(0));
    const double turn = half.dot(UpOf(last)) > 0 ? 1 : -1;
    const double level = network.all(kFirstControl + kPathFeatures, 0);
    turns += turn;
    together += turn * level;
    energy += level;
    square += level * level;
  }
  EXPECT_LT(std::abs(turns), 0.3 * kSeeds) << "both ways";
  const double variance = square / kSeeds - std::pow(energy / kSeeds, 2);
  ASSERT_GT(variance, 0.01);
  const double covariance = together / kSeeds - turns / kSeeds * energy / kSeeds;
  EXPECT_LT(std::abs(covariance) / std::sqrt(variance), 0.3);
}

// A long distance needs energy; the key gives the distance as far as it is known.
TEST(KnownOfEnergy, ContainsTheDistanceToTheKey) {
  const FlowModelParts parts = Parts();
  const Skeleton& skeleton = parts.skeleton;
  constexpr auto kTrunk = static_cast<int>(BodyPart::kTrunk);
  constexpr auto kLeftArm = static_cast<int>(BodyPart::kLeftArm);
  const std::vector<Pose> history(2, RestPose(skeleton));
  WindowRequest request{{.frames = 30, .history = history}, 30};
  EXPECT_FALSE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way)
      << "there is no key";
  request.target = Target{RestPose(skeleton), {}};
  const EnergyPrior::Known still = KnownOfEnergy(parts, request, FlowWindow(parts.prior, request));
  ASSERT_TRUE(still.way && still.way_in_world);

  request.target->pose.root_position.x() += 3;
  const EnergyPrior::Known moved = KnownOfEnergy(parts, request, FlowWindow(parts.prior, request));
  EXPECT_EQ((*moved.way)[kLeftArm], (*still.way)[kLeftArm]);
  EXPECT_GT((*moved.way)[kTrunk], (*still.way)[kTrunk]);
  for (const double level : *moved.way_in_world)
    EXPECT_NEAR(level, std::log((0.1 + 1e-3) / 1e-3), 1e-9) << "ten centimetres a frame";

  request.target->pose.rotations(2, skeleton.left_shoulder) = 1;
  EXPECT_GT((*KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way)[kLeftArm],
            (*still.way)[kLeftArm]);
}

// A dancer who came out of a held pose was taken for one of median liveliness, and burst out of it.
TEST(KnownOfEnergy, AStillHistoryIsTheCalmest) {
  FlowModelParts parts = Parts();
  parts.energy.least.segment<kBodyParts>(EnergyPrior::kHistoryInput).setConstant(-3);
  const std::vector<Pose> history(2, RestPose(parts.skeleton));
  WindowRequest request{{.frames = 30, .history = history}, 30};
  request.target = Target{RestPose(parts.skeleton), {}};
  const auto known = KnownOfEnergy(parts, request, FlowWindow(parts.prior, request));
  EXPECT_TRUE((known.history.array() == -3).all()) << known.history.transpose();
}

// Else dances through few keys would be as slow as the mean way to them.
TEST(KnownOfEnergy, OmitsAKeyBeyondTheWindow) {
  const FlowModelParts parts = Parts();
  const std::vector<Pose> history(2, RestPose(parts.skeleton));
  WindowRequest request{
      {.frames = 30, .history = history, .target = Target{RestPose(parts.skeleton), {}}}, 60};
  const EnergyPrior::Known far = KnownOfEnergy(parts, request, FlowWindow(parts.prior, request));
  EXPECT_FALSE(far.key);
  EXPECT_FALSE(far.way);
  request.to_key = 30;
  EXPECT_TRUE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).key);
}

TEST(KnownOfEnergy, OmitsDistancesThatTheMaskLeavesOpen) {
  const FlowModelParts parts = Parts();
  const Skeleton& skeleton = parts.skeleton;
  const std::vector<Pose> history(2, RestPose(skeleton));
  WindowRequest request{
      {.frames = 30, .history = history, .target = Target{RestPose(skeleton), {}}}, 30};
  request.target->mask.root_position = false;
  EXPECT_TRUE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way);
  EXPECT_FALSE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way_in_world);

  request.target->mask.joints.assign(static_cast<size_t>(skeleton.joints()), true);
  request.target->mask.joints[static_cast<size_t>(skeleton.Find("left_wrist"))] = false;
  EXPECT_TRUE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way)
      << "a hand is nothing";
  request.target->mask.joints[static_cast<size_t>(skeleton.Find("left_elbow"))] = false;
  EXPECT_FALSE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way)
      << "a forearm is something";
}

}  // namespace choreo::window_energy_test
