#include <gtest/gtest.h>
#include <torch/torch.h>

#include "model/core/error.h"
#include "model/flow/flow_model.h"
#include "model/flow/torch_kinematics.h"
#include "model/motion/mirror.h"

namespace choreo {
namespace {

using torch::Tensor;

FlowConfig Small(bool recurrent, bool encoded, bool planned) {
  FlowConfig config;
  config.flow_steps = 3;
  config.hidden = 16;
  config.recurrent = recurrent;
  config.condition_width = encoded ? 24 : 0;
  if (planned) config.planner = {.width = 24, .layers = 1, .heads = 2};
  return config;
}

// Zero-initialised last layers hide mistakes in the couplings: give every parameter a value.
void Shake(torch::nn::Module& module) {
  torch::NoGradGuard no_grad;
  for (auto& parameter : module.parameters()) parameter.add_(0.01 * torch::randn_like(parameter));
}

TransitionTensors RandomTransition(int64_t batch, int64_t frames) {
  const int64_t joints = Skeleton::Smpl24().joints();
  return {frames,
          0.1 * torch::randn({batch, 10, 3}),
          ExpMapBatch(0.3 * torch::randn({batch, 10, joints, 3})),
          0.3 * torch::randn({batch, 3}),
          ExpMapBatch(0.3 * torch::randn({batch, joints, 3})),
          torch::ones({batch, joints + 1})};
}

struct Case {
  const char* name;
  bool recurrent, encoded, planned;
};

class FlowTest : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    torch::manual_seed(11);
    const Case& c = GetParam();
    model_ = FlowModel(Small(c.recurrent, c.encoded, c.planned), Skeleton::Smpl24());
    Shake(*model_);
    model_->eval();
  }
  // Raw: past frames, music and its flag, then the key's position, rotations and mask, and the time
  // embedding.
  int64_t ConditionWidth() const {
    const int64_t width = model_->feature_width();
    return GetParam().encoded ? 24 : 10 * width + (11 * 40 + 1) + (3 + 6 * 24 + 25) + width;
  }
  FlowModel model_{nullptr};
};

TEST_P(FlowTest, InverseOfForwardIsTheIdentity) {
  torch::NoGradGuard no_grad;
  const int64_t width = model_->feature_width(), frames = 6;
  const Tensor x = torch::randn({4, frames, width});
  CouplingFlow flow = model_->flow();
  const int64_t condition = ConditionWidth();
  const Tensor c = torch::randn({4, frames, condition});
  FlowState state = flow->InitialState(4);
  Tensor forward_det = torch::zeros({4, frames});
  const Tensor z = flow->Forward(x, c, &state, &forward_det);
  EXPECT_GT((z - x).abs().max().item<double>(), 0.1);  // it does something

  // Frame by frame, as sampling goes.
  const auto inverse = flow->InverseWeights();
  state = flow->InitialState(4);
  Tensor inverse_det = torch::zeros({4, 1});
  double worst = 0;
  for (int64_t t = 0; t < frames; ++t) {
    const Tensor back =
        flow->Inverse(z.narrow(1, t, 1), c.narrow(1, t, 1), inverse, &state, &inverse_det);
    worst = std::max(worst, (back.squeeze(1) - x.select(1, t)).abs().max().item<double>());
  }
  EXPECT_LE(worst, 1e-4);
  EXPECT_TRUE(torch::allclose(inverse_det.squeeze(1), forward_det.sum(1), 1e-4, 1e-3));
}

TEST_P(FlowTest, LogDeterminantIsAutogradsOwn) {
  CouplingFlow flow = model_->flow();
  flow->to(torch::kFloat64);
  const int64_t width = model_->feature_width();
  const int64_t condition = ConditionWidth();
  const Tensor c = torch::randn({1, 1, condition}, torch::kFloat64);
  Tensor x = torch::randn({1, 1, width}, torch::kFloat64).set_requires_grad(true);
  FlowState state = flow->InitialState(1);
  Tensor log_det = torch::zeros({1, 1}, torch::kFloat64);
  const Tensor z = flow->Forward(x, c, &state, &log_det).flatten();
  std::vector<Tensor> rows;
  for (int64_t i = 0; i < width; ++i) {
    rows.push_back(torch::autograd::grad({z[i]}, {x}, {}, true)[0].flatten());
  }
  const double expected = std::get<1>(torch::linalg_slogdet(torch::stack(rows))).item<double>();
  EXPECT_NEAR(log_det.item<double>(), expected, 1e-6 * std::abs(expected) + 1e-6);
}

TEST_P(FlowTest, ARolloutsOwnLikelihoodIsThatOfItsNoise) {
  torch::NoGradGuard no_grad;
  const int64_t frames = 5, width = model_->feature_width();
  const TransitionTensors transition = RandomTransition(3, frames);
  const TransitionContext context = model_->Begin(transition);
  const Tensor history = 0.2 * torch::randn({3, 10, width});
  const Tensor audio = torch::randn({3, 10 + frames, 40});
  const Tensor has_audio = torch::ones({3, 1});
  const Tensor noise = 0.5 * torch::randn({3, frames, width});
  const Tensor sampled = model_->Rollout(history, audio, has_audio, context, noise);
  const Tensor likelihood =
      model_->LogLikelihood(torch::cat({history, sampled}, 1), audio, has_audio, context);

  FlowState state = model_->flow()->InitialState(3);
  const auto step = model_->Step(history, audio.narrow(1, 0, 11), has_audio,
                                 context.static_condition.select(1, 0), noise.select(1, 0),
                                 model_->InverseWeights(), &state);
  EXPECT_TRUE(torch::allclose(step.log_likelihood, likelihood.select(1, 0), 1e-3, 1e-2));
  EXPECT_TRUE(torch::allclose(step.features, sampled.select(1, 0), 1e-5, 1e-5));
}

TEST_P(FlowTest, MusicKeyAndTimeLeftChangeTheDance) {
  torch::NoGradGuard no_grad;
  const int64_t frames = 4, width = model_->feature_width();
  const TransitionTensors transition = RandomTransition(1, frames);
  const Tensor history = 0.2 * torch::randn({1, 10, width});
  const Tensor audio = torch::randn({1, 10 + frames, 40});
  const Tensor noise = torch::zeros({1, frames, width});
  const auto dance = [&](const TransitionTensors& of, const Tensor& music, double has_audio) {
    const TransitionContext context = model_->Begin(of);
    return model_->Rollout(history, music, torch::full({1, 1}, has_audio), context, noise);
  };
  const Tensor base = dance(transition, audio, 1);
  const auto differs = [&](const Tensor& other) {
    return (other - base).abs().max().item<double>();
  };
  EXPECT_GT(differs(dance(transition, audio + 1, 1)), 1e-6);
  EXPECT_GT(differs(dance(transition, audio, 0)), 1e-6);
  TransitionTensors other = transition;
  other.target_mask = torch::zeros_like(transition.target_mask);
  EXPECT_GT(differs(dance(other, audio, 1)), 1e-6);
  EXPECT_EQ(differs(dance(transition, audio, 1)), 0);
}

TEST_P(FlowTest, AMirroredTransitionHasTheMirroredPlan) {
  if (!GetParam().planned) return;  // no plan
  torch::NoGradGuard no_grad;
  const TransitionTensors transition = RandomTransition(2, 12);
  const std::vector<int> of = MirrorPairs(Skeleton::Smpl24());
  const Tensor pairs = torch::tensor(std::vector<int64_t>(of.begin(), of.end()));
  const TrajectoryTensors plan = model_->Begin(transition).reference;
  const TrajectoryTensors other = model_->Begin(MirrorTransition(transition, pairs)).reference;
  const Tensor flip = torch::tensor({-1.0F, 1.0F, 1.0F});
  EXPECT_TRUE(torch::allclose(plan.position * flip, other.position, 1e-4, 1e-5));
  EXPECT_TRUE(torch::allclose(plan.rotation.index_select(2, pairs) * torch::outer(flip, flip),
                              other.rotation, 1e-4, 1e-4));
}

INSTANTIATE_TEST_SUITE_P(Shapes, FlowTest,
                         testing::Values(Case{"Paper", true, false, false},
                                         Case{"Encoded", true, true, false},
                                         Case{"Planned", false, true, true}),
                         [](const auto& shape) { return std::string(shape.param.name); });

TEST(Planner, StartsAsInterpolationAndEndsOnTheKey) {
  torch::NoGradGuard no_grad;
  torch::manual_seed(5);
  const Planner planner = MakePlanner(24, {.width = 24, .layers = 1, .heads = 2});
  const TransitionTensors transition = RandomTransition(2, 20);
  const TrajectoryTensors line = Interpolate(transition);
  EXPECT_TRUE(
      torch::allclose(planner->forward(transition).trajectory.position, line.position, 1e-5, 1e-6));
  EXPECT_TRUE(torch::allclose(line.position.select(1, 19), transition.target_position, 1e-5, 1e-5));
  EXPECT_TRUE(torch::allclose(line.rotation.select(1, 19), transition.target_rotation, 1e-4, 1e-4));
  Shake(*planner);
  const auto shaken = planner->forward(transition).trajectory;
  EXPECT_GT((shaken.position - line.position).abs().max().item<double>(), 1e-3);
  EXPECT_TRUE(
      torch::allclose(shaken.position.select(1, 19), transition.target_position, 1e-5, 1e-5));
  EXPECT_TRUE(
      torch::allclose(shaken.rotation.select(1, 19), transition.target_rotation, 1e-4, 1e-4));
}

// A dancer who spins to her left by `rate` radians a frame, and a key that is `turn` radians ahead.
TransitionTensors Spin(double rate, double turn, int64_t frames) {
  TransitionTensors spin = RandomTransition(1, frames);
  const auto heading = [](double angle) {
    return ExpMapBatch(torch::tensor({0.0F, static_cast<float>(angle), 0.0F}));
  };
  const int64_t history = spin.history_position.size(1);
  for (int64_t s = 0; s < history; ++s) {
    spin.history_rotation[0][s][0] = heading(rate * static_cast<double>(s - history + 1));
  }
  spin.target_rotation[0][0] = heading(turn);
  return spin;
}

TEST(Interpolation, GoesTheWayRoundThatTheDancerIsTurning) {
  const auto first_turn = [](const TransitionTensors& spin, bool as_turning) {
    const auto line = Interpolate(spin, as_turning);
    const Tensor before = spin.history_rotation[0][-1][0], after = line.rotation[0][0][0];
    return LogMapBatch(torch::matmul(before.t(), after))[1].item<double>();
  };
  // 190 degrees to the left are 170 to the right.
  const double left = 190 * M_PI / 180, right = left - 2 * M_PI;
  EXPECT_NEAR(first_turn(Spin(0.1, left, 30), false), right / 30, 1e-4);
  EXPECT_NEAR(first_turn(Spin(0.1, left, 30), true), left / 30, 1e-4);
  EXPECT_NEAR(first_turn(Spin(-0.1, left, 30), true), right / 30, 1e-4);
  EXPECT_NEAR(first_turn(Spin(0, left, 30), true), right / 30, 1e-4);
  // A quarter turn against the spin stays one.
  EXPECT_NEAR(first_turn(Spin(0.1, -M_PI / 2, 30), true), -M_PI / 60, 1e-4);
}

TEST(Planner, TheRecurrentOneStandsStillUntilTrainedThenHeedsKeyAndTime) {
  torch::NoGradGuard no_grad;
  torch::manual_seed(5);
  const Planner planner = MakePlanner(24, {.width = 24, .recurrent = true});
  TransitionTensors transition = RandomTransition(2, 20);
  planner->eval();
  const auto still = planner->forward(transition).trajectory;
  EXPECT_TRUE(torch::allclose(still.position.select(1, 19),
                              transition.history_position.select(1, -1), 1e-5, 1e-6));
  Shake(*planner);
  const auto plan = planner->forward(transition);
  EXPECT_EQ(plan.hidden.sizes(), (std::vector<int64_t>{2, 20, 24}));
  EXPECT_TRUE(
      torch::equal(plan.trajectory.position, planner->forward(transition).trajectory.position));
  // Its first frame knows of the key and of the frames that are left.
  const auto first = [&] { return planner->forward(transition).trajectory.position.select(1, 0); };
  const Tensor before = first();
  transition.frames = 40;
  EXPECT_FALSE(torch::equal(first(), before));
  transition.frames = 20;
  transition.target_position = transition.target_position + 1;
  EXPECT_FALSE(torch::equal(first(), before));
  // A key that is masked is not there.
  transition.target_mask.zero_();
  const Tensor free = first();
  transition.target_position = transition.target_position + 1;
  EXPECT_TRUE(torch::equal(first(), free));
}

TEST(TimeEmbeddingTest, IsEquationNine) {
  const Tensor e = TimeEmbedding(torch::tensor({7.0}, torch::kFloat64), 82)[0];
  for (const int l : {0, 1, 20, 40}) {
    const double phase = 7.0 / std::pow(10000.0, 2.0 * l / 82);
    EXPECT_NEAR(e[2 * l].item<double>(), std::sin(phase), 1e-9);
    EXPECT_NEAR(e[2 * l + 1].item<double>(), std::cos(phase), 1e-9);
  }
}

TEST(FlowPresets, HaveTheSizesThatTheyPromise) {
  const auto parameters = [](const char* name) {
    FlowModel model(FlowConfig::Preset(name), Skeleton::Smpl24());
    int64_t count = 0;
    for (const auto& parameter : model->parameters()) count += parameter.numel();
    return count;
  };
  EXPECT_LE(parameters("planned"), 4'000'000);
  EXPECT_LE(parameters("ablation"), 500'000);
  EXPECT_NEAR(static_cast<double>(parameters("paper")), 99e6, 4e6);
  EXPECT_THROW(FlowConfig::Preset("large"), Error);
}

}  // namespace
}  // namespace choreo
