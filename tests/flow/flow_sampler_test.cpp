#include "model/flow/flow_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "model/motion/pose/body_limits.h"
#include "tests/flow/flow_networks.h"

namespace choreo::flow_sampler_test {

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
  const auto one = Window(parts, network, scene.request, {.seed = 1, .temperature = 0});
  EXPECT_EQ(network.evaluations, 2);
  const auto other = Window(parts, network, scene.request, {.seed = 2, .temperature = 0});
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
  EXPECT_LT(Apart(poses.back(), scene.request.target->pose), 1e-2);
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
  scene.request.target.reset();
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

ModelInfo ControlledModel(const FlowModelParts& parts) {
  ModelInfo model;
  model.skeleton = parts.skeleton;
  model.history_frames = kTau;
  model.controls = ControlNames();
  return model;
}

// A second in which each part of the body is asked for 0.05 m a frame.
TransitionSpec RequestedEnergy() {
  TransitionSpec spec;
  spec.frames = 30;
  spec.history = MakeScene(30).request.history;
  spec.temperature = 1;
  spec.controls[kVelocityFactors].values.setConstant(kBodyParts, spec.frames, 0.05F);
  return spec;
}

// So that the check of plans says which frame is not finite.
TEST(FlowSampler, APlanThatMissesItsEnergyInfinitelyHasPoses) {
  const auto parts = std::make_shared<const FlowModelParts>(Parts());
  const ModelInfo model = ControlledModel(*parts);
  ContinuousFlowSampler sampler(model, "cpu", parts, std::make_shared<const Diverging>());
  EXPECT_EQ(sampler.Sample(ValidSpec(RequestedEnergy(), model)).Finish().poses.size(), 30U);
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
  FlowModelParts wide = Parts();
  wide.prior = MotionPrior(8 * wide.prior.covariance());  // so that flailing is too fast
  const auto parts = std::make_shared<const FlowModelParts>(wide);
  const ModelInfo model = ControlledModel(*parts);
  TransitionSpec spec = RequestedEnergy();
  for (const int spare : {0, 1, 3, kMaxTakes - 1}) {
    const auto always = std::make_shared<const Flailing>(1000);
    ContinuousFlowSampler sampler(model, "cpu", parts, always);
    spec.spare_frames = spare * spec.frames;
    const Plan plan = sampler.Sample(ValidSpec(spec, model)).Finish();
    EXPECT_EQ(plan.resampled, spec.spare_frames);
    EXPECT_EQ(always->evaluations, (1 + spare) * parts->config.steps);
  }
}

TEST(FlowSampler, TurningTheSceneTurnsTheDance) {
  const Scene scene = MakeScene(60);
  const FlowModelParts parts = Parts();
  const Silent network;
  const TransitionNoise noise{.seed = 5, .temperature = 1};
  const auto here = Transition(parts, network, scene.request, noise);
  const GroundFrame elsewhere{.origin = {1, 0, -2}, .heading = 0.7};
  WindowRequest turned = scene.request;
  for (Pose& pose : turned.history) pose = elsewhere.ToWorld(pose);
  turned.target->pose = elsewhere.ToWorld(turned.target->pose);
  const auto there = Transition(parts, network, turned, noise);
  for (size_t i = 0; i < here.size(); ++i)
    EXPECT_LT(Apart(elsewhere.ToWorld(here[i]), there[i]), 1e-6);
}

}  // namespace choreo::flow_sampler_test
