#include "model/flow/flow_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "model/flow/window_energy.h"
#include "model/motion/body_limits.h"
#include "model/motion/rotation.h"
#include "tests/flow/flow_scene.h"

namespace choreo::flow_sampler_test {

std::vector<Pose> Window(const FlowModelParts& model, const FlowNetwork& network,
                         const WindowRequest& request, const FlowNoise& noise) {
  return SampleWindow(model, network, request, noise).Finish();
}

std::vector<Pose> Transition(const FlowModelParts& model, const FlowNetwork& network,
                             const WindowRequest& request, const FlowNoise& noise) {
  SpareFrames spare = SpareFrames::Of(request.frames);
  return SampleTransition(model, network, request, noise, &spare).Finish();
}

// Has learnt nothing: its dances are the prior's.
class Silent : public FlowNetwork {
 public:
  Eigen::MatrixXf Condition(const Eigen::VectorXf& whole,
                            std::span<const float> times) const override {
    EXPECT_TRUE(whole.allFinite());
    Eigen::MatrixXf condition(whole.size() + 1, std::ssize(times));
    condition.topRows(whole.size()).colwise() = whole;
    std::ranges::copy(times, condition.bottomRows<1>().begin());
    return condition;
  }
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                           const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                           const Eigen::MatrixXf& frames,
                           const Eigen::VectorXf& condition) const override {
    EXPECT_EQ(joints.cols(), z.cols() + kTau);
    EXPECT_EQ(joints.rows(), z.rows() - 3);
    EXPECT_TRUE(joints.row(1).minCoeff() > 0.3);  // the pelvis stands above the floor
    EXPECT_EQ(poses.cols(), z.cols() + kTau);
    EXPECT_EQ(mean.cols(), z.cols() + kTau);
    EXPECT_EQ(frames.rows(), FrameFeatures());
    EXPECT_TRUE(frames.allFinite());
    EXPECT_TRUE(condition.tail<1>()[0] >= 0 && condition.tail<1>()[0] < 1);
    ++evaluations;
    return Eigen::MatrixXf::Zero(z.rows(), z.cols());
  }
  mutable int evaluations = 0;
};

// Favours one side.
class Lopsided : public Silent {
 public:
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                           const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                           const Eigen::MatrixXf& frames,
                           const Eigen::VectorXf& condition) const override {
    Eigen::MatrixXf f = Silent::Evaluate(z, poses, joints, mean, frames, condition);
    f.middleRows<3>(3 + 3 * 16).setConstant(0.5F);  // the left arm
    return f;
  }
};

TEST(FlowSampler, MeanOfMirroredRequestIsMirrored) {
  const Scene scene = MakeScene(30);
  const FlowModelParts parts = Parts();
  const std::vector<int> pairs = MirrorPairs(parts.skeleton);
  const Lopsided network;
  const auto apart = [&](double temperature) {
    const auto one = Window(parts, network, scene.request, {.temperature = temperature});
    const auto other =
        Window(parts, network, Mirror(pairs, scene.request), {.temperature = temperature});
    return Apart(one[15], Mirror(pairs, other[15]));
  };
  EXPECT_LT(apart(0), 1e-9);
  EXPECT_GT(apart(1), 0.01);
}

TEST(FlowSampler, MeanTakesOneStepAndIgnoresTheSeed) {
  const Scene scene = MakeScene(30);
  const FlowModelParts parts = Parts();
  const Silent network;
  const auto one = Window(parts, network, scene.request, {.seed = 1});
  EXPECT_EQ(network.evaluations, 2);
  const auto other = Window(parts, network, scene.request, {.seed = 2});
  for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(Apart(one[i], other[i]), 0);
}

TEST(FlowSampler, SeedsGiveDifferentMotionsToTheSameKey) {
  const Scene scene = MakeScene(30);
  const FlowModelParts parts = Parts();
  const Silent network;
  const auto sample = [&](uint64_t seed, double temperature) {
    return Window(parts, network, scene.request, {.seed = seed, .temperature = temperature});
  };
  const auto a = sample(1, 1), b = sample(2, 1), calm = sample(1, 0.1), again = sample(1, 1);
  const auto mean = sample(1, 0);
  EXPECT_GT(Apart(a[15], b[15]), 0.02);
  EXPECT_LT(Apart(calm[15], mean[15]), Apart(a[15], mean[15]));
  EXPECT_LT(Apart(a.back(), b.back()), 5e-3);
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(Apart(a[i], again[i]), 0);
}

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

// Moves everything by `step` if given beats, or one of `styles`.
class Hearing : public Silent {
 public:
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf& poses,
                           const Eigen::MatrixXf& joints, const Eigen::MatrixXf& mean,
                           const Eigen::MatrixXf& frames,
                           const Eigen::VectorXf& condition) const override {
    const bool hears =
        frames.row(1).any() || condition.segment(condition.size() - 1 - styles, styles).any();
    return Silent::Evaluate(z, poses, joints, mean, frames, condition).array() + (hears ? step : 0);
  }
  float step = 0;
  int styles = 0;
};

// Samples `request`, labelled by its beats or its style, with and without guidance.
void ExpectGuidance(WindowRequest request, FlowModelParts parts) {
  Hearing network;
  network.styles = static_cast<int>(parts.config.styles.size());
  const auto sample = [&](double guidance, float step) {
    parts.config.guidance = guidance;
    network.step = step;
    network.evaluations = 0;
    return Window(parts, network, request, {.seed = 1, .temperature = 1});
  };
  const auto twice = sample(2, 0.125F);
  // Of beats alone, the last step takes the effect from the step before.
  const int without = parts.config.steps - (request.style < 0 ? 1 : 0);
  EXPECT_EQ(network.evaluations, parts.config.steps + without);
  const auto once = sample(1, 0.25F);
  EXPECT_EQ(network.evaluations, parts.config.steps);
  for (size_t i = 0; i < once.size(); ++i) EXPECT_EQ(Apart(once[i], twice[i]), 0);
  const auto weak = sample(1, 0.125F);
  EXPECT_GT(Apart(weak[15], once[15]), 1e-3);
  request.beats.clear();
  request.style = -1;
  sample(2, 0.125F);
  EXPECT_EQ(network.evaluations, parts.config.steps);
}

TEST(FlowSampler, GuidanceScalesTheEffectOfBeatsAndStyle) {
  Scene scene = MakeScene(30);
  FlowModelParts parts = Parts();
  parts.config.styles = {"waltz", "tango"};
  parts.energy = EnergyPrior(parts.config.styles.size());
  scene.request.style = 1;
  ExpectGuidance(scene.request, parts);
  scene.request.beats = {0, 15, 30};
  ExpectGuidance(scene.request, parts);
  scene.request.style = -1;
  ExpectGuidance(scene.request, parts);
}

TEST(FlowSampler, FollowsAPathExactlyAndItsHeightsIfGiven) {
  Scene scene = MakeScene(30);
  scene.request.controls[kRootPath].values.resize(3, 30);
  for (int i = 0; i < 30; ++i)
    scene.request.controls[kRootPath].values.col(i) =
        scene.truth[static_cast<size_t>(i)].root_position;
  const FlowModelParts parts = Parts();
  const Silent network;
  for (const bool heights : {false, true}) {
    scene.request.controls[kRootPath].requested[1] = heights;
    const auto poses = Window(parts, network, scene.request, {.seed = 3, .temperature = 1});
    for (size_t i = 0; i < poses.size(); ++i) {
      const Eigen::Vector3d miss = poses[i].root_position - scene.truth[i].root_position;
      EXPECT_LT(std::hypot(miss.x(), miss.z()), 1e-9);
      EXPECT_LT(heights ? std::abs(miss.y()) : 0, 1e-9);
    }
  }
}

TEST(FlowSampler, LongTransitionsJoinSmoothlyAndReachTheirKey) {
  const Scene scene = MakeScene(100);
  const FlowModelParts parts = Parts();
  const Silent network;
  const auto poses = Transition(parts, network, scene.request, {.seed = 5, .temperature = 1});
  EXPECT_EQ(network.evaluations, 3 * parts.config.steps);
  ASSERT_EQ(poses.size(), 100U);
  EXPECT_LT(Apart(poses.back(), *scene.request.key), 1e-2);
  double fastest = 0, at_cuts = 0;
  for (size_t i = 1; i < poses.size(); ++i) {
    const double step = Apart(poses[i - 1], poses[i]);
    fastest = std::max(fastest, step);
    if (i == 33 || i == 66) at_cuts = std::max(at_cuts, step);
  }
  EXPECT_LE(at_cuts, fastest);
}

// Sinks into the floor in its first window, and in no other.
class Sinking : public Silent {
 public:
  explicit Sinking(int steps) : steps_(steps) {}
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf&, const Eigen::MatrixXf&,
                           const Eigen::MatrixXf&, const Eigen::MatrixXf&,
                           const Eigen::VectorXf&) const override {
    Eigen::MatrixXf f = Eigen::MatrixXf::Zero(z.rows(), z.cols());
    if (evaluations++ < steps_) f.row(1).setConstant(-2.5);
    return f;
  }

 private:
  int steps_;
};

TEST(FlowSampler, FreeWindowsThatEndWhereNobodyDancesAreSampledAgain) {
  Scene scene = MakeScene(30);
  scene.request.key.reset();
  FlowModelParts parts = Parts();
  UsualPose usual;
  usual.pose = RestPose(parts.skeleton);
  usual.variance = Eigen::VectorXd::Ones(parts.prior.dimensions());
  const auto sample = [&](const FlowNetwork& network) {
    parts.prior = MotionPrior(parts.prior.covariance(), parts.prior.powers(), usual);
    return Transition(parts, network, scene.request, {.seed = 5, .temperature = 1}).back();
  };
  const double low = usual.Deviation(sample(Sinking(parts.config.steps)));
  const double common = usual.Deviation(sample(Silent()));
  ASSERT_GT(low, 2 * common);
  // Such that the sunken window is farther than seven standard deviations, and others are not.
  usual.variance.setConstant(std::pow(std::sqrt(low * common) / 7, 2));
  const Sinking network(parts.config.steps);
  EXPECT_LT(usual.Deviation(sample(network)), 7);
  EXPECT_EQ(network.evaluations, 2 * parts.config.steps);
}

// Puts one frame infinitely far away.
class Diverging : public Silent {
 public:
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf&, const Eigen::MatrixXf&,
                           const Eigen::MatrixXf&, const Eigen::MatrixXf&,
                           const Eigen::VectorXf&) const override {
    Eigen::MatrixXf f = Eigen::MatrixXf::Zero(z.rows(), z.cols());
    f(0, 15) = std::numeric_limits<float>::infinity();
    return f;
  }
};

// So that the check of plans says which frame is not finite.
TEST(FlowSampler, APlanThatMissesItsEnergyInfinitelyHasPoses) {
  const auto parts = std::make_shared<const FlowModelParts>(Parts());
  ModelInfo model;
  model.skeleton = parts->skeleton;
  model.history_frames = kTau;
  model.controls = ControlNames();
  TransitionSpec spec;
  spec.frames = 30;
  spec.history = MakeScene(30).request.history;
  spec.temperature = 1;
  spec.controls[kVelocityFactors].values.setConstant(kBodyParts, spec.frames, 0.05F);
  ContinuousFlowSampler sampler(model, "cpu", parts, std::make_shared<const Diverging>());
  EXPECT_EQ(sampler.Begin(ValidSpec(spec, model)).Finish().poses.size(), 30U);
}

// Throws an arm about in its first window, and in no other.
class Flailing : public Silent {
 public:
  explicit Flailing(int steps) : steps_(steps) {}
  Eigen::MatrixXf Evaluate(const Eigen::MatrixXf& z, const Eigen::MatrixXf&, const Eigen::MatrixXf&,
                           const Eigen::MatrixXf&, const Eigen::MatrixXf&,
                           const Eigen::VectorXf&) const override {
    Eigen::MatrixXf f = Eigen::MatrixXf::Zero(z.rows(), z.cols());
    if (evaluations++ < steps_) f.middleRows<3>(3 + 3 * 16).setConstant(20);
    return f;
  }

 private:
  int steps_;
};

// To a pose that no recording has, one sample of four threw hands about at 16 m/s.
TEST(FlowSampler, WindowsFasterThanPeopleAreSampledAgain) {
  const Scene scene = MakeScene(30);
  FlowModelParts parts = Parts();
  parts.prior = MotionPrior(8 * parts.prior.covariance());
  const auto speed = [&](const FlowNetwork& network, double temperature) {
    const auto poses =
        Transition(parts, network, scene.request, {.seed = 5, .temperature = temperature});
    return FindFastestStep(parts.skeleton, scene.request.history.back(), poses, 30).m_per_s;
  };
  ASSERT_LT(speed(Silent(), 1), kFastestJoint);
  // All windows flail: there is no better one.
  const Flailing always(1000);
  ASSERT_GT(speed(always, 1), kFastestJoint);
  EXPECT_EQ(always.evaluations, 5 * parts.config.steps);
  const Flailing once(parts.config.steps);
  EXPECT_LT(speed(once, 1), kFastestJoint);
  EXPECT_EQ(once.evaluations, 2 * parts.config.steps);
}

// Windows, takes and rounds share a budget.
TEST(FlowSampler, RequestedEnergySamplesNoMoreThanTheBudget) {
  const auto parts = std::make_shared<const FlowModelParts>(Parts());
  ModelInfo model;
  model.skeleton = parts->skeleton;
  model.history_frames = kTau;
  model.controls = ControlNames();
  TransitionSpec spec;
  spec.frames = 30;
  spec.history = MakeScene(30).request.history;
  spec.temperature = 1;
  spec.controls[kVelocityFactors].values.setConstant(kBodyParts, spec.frames, 0.05F);
  for (const int spare : {0, 1, 3, kMaxTakes - 1}) {
    const auto always = std::make_shared<const Flailing>(1000);
    ContinuousFlowSampler sampler(model, "cpu", parts, always);
    spec.spare_frames = spare * spec.frames;
    const Plan plan = sampler.Begin(ValidSpec(spec, model)).Finish();
    EXPECT_EQ(plan.resampled, spec.spare_frames);
    EXPECT_EQ(always->evaluations, (1 + spare) * parts->config.steps);
  }
}

TEST(FlowSampler, TurningTheSceneTurnsTheDance) {
  const Scene scene = MakeScene(60);
  const FlowModelParts parts = Parts();
  const Silent network;
  const FlowNoise noise{.seed = 5, .temperature = 1};
  const auto here = Transition(parts, network, scene.request, noise);
  const GroundFrame elsewhere{.origin = {1, 0, -2}, .heading = 0.7};
  WindowRequest turned = scene.request;
  for (Pose& pose : turned.history) pose = elsewhere.ToWorld(pose);
  turned.key = elsewhere.ToWorld(*turned.key);
  const auto there = Transition(parts, network, turned, noise);
  for (size_t i = 0; i < here.size(); ++i)
    EXPECT_LT(Apart(elsewhere.ToWorld(here[i]), there[i]), 1e-6);
}

// Each is decided by a random number of its own.
TEST(FlowSampler, TheWayRoundToAKeyTellsNothingOfTheTrunksEnergy) {
  Scene scene = MakeScene(10);
  const Pose& last = scene.request.history.back();
  scene.request.key = last;
  scene.request.key->rotations.col(0) =
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
  WindowRequest request{.frames = 30, .history = history, .to_key = 30};
  EXPECT_FALSE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way)
      << "there is no key";
  request.key = RestPose(skeleton);
  const EnergyPrior::Known still = KnownOfEnergy(parts, request, FlowWindow(parts.prior, request));
  ASSERT_TRUE(still.way && still.way_in_world);

  request.key->root_position.x() += 3;
  const EnergyPrior::Known moved = KnownOfEnergy(parts, request, FlowWindow(parts.prior, request));
  EXPECT_EQ((*moved.way)[kLeftArm], (*still.way)[kLeftArm]);
  EXPECT_GT((*moved.way)[kTrunk], (*still.way)[kTrunk]);
  for (const double level : *moved.way_in_world)
    EXPECT_NEAR(level, std::log((0.1 + 1e-3) / 1e-3), 1e-9) << "ten centimetres a frame";

  request.key->rotations(2, skeleton.left_shoulder) = 1;
  EXPECT_GT((*KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way)[kLeftArm],
            (*still.way)[kLeftArm]);
}

// A dancer who came out of a held pose was taken for one of median liveliness, and burst out of it.
TEST(KnownOfEnergy, AStillHistoryIsTheCalmest) {
  FlowModelParts parts = Parts();
  parts.energy.least.segment<kBodyParts>(EnergyPrior::kHistoryInput).setConstant(-3);
  const std::vector<Pose> history(2, RestPose(parts.skeleton));
  WindowRequest request{.frames = 30, .history = history, .to_key = 30};
  request.key = RestPose(parts.skeleton);
  const auto known = KnownOfEnergy(parts, request, FlowWindow(parts.prior, request));
  EXPECT_TRUE((known.history.array() == -3).all()) << known.history.transpose();
}

// Else dances through few keys would be as slow as the mean way to them.
TEST(KnownOfEnergy, OmitsAKeyBeyondTheWindow) {
  const FlowModelParts parts = Parts();
  const std::vector<Pose> history(2, RestPose(parts.skeleton));
  WindowRequest request{
      .frames = 30, .history = history, .key = RestPose(parts.skeleton), .to_key = 60};
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
  WindowRequest request{.frames = 30, .history = history, .key = RestPose(skeleton), .to_key = 30};
  request.mask.root_position = false;
  EXPECT_TRUE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way);
  EXPECT_FALSE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way_in_world);

  request.mask.joints.assign(static_cast<size_t>(skeleton.joints()), true);
  request.mask.joints[static_cast<size_t>(skeleton.Find("left_wrist"))] = false;
  EXPECT_TRUE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way)
      << "a hand is nothing";
  request.mask.joints[static_cast<size_t>(skeleton.Find("left_elbow"))] = false;
  EXPECT_FALSE(KnownOfEnergy(parts, request, FlowWindow(parts.prior, request)).way)
      << "a forearm is something";
}

}  // namespace choreo::flow_sampler_test
