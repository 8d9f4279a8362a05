#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/nn/module.h>
#include <torch/nn/modules/rnn.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <cmath>
#include <numbers>

#include "model/core/error.h"
#include "model/flow/network/torch_kinematics.h"
#include "model/motion/rotation.h"
#include "model/papers/networks/frame_flow_model.h"
#include "model/papers/networks/key_condition.h"

namespace choreo::flow_test {

using torch::Tensor;

enum class Form { kPaper, kEncoded, kInnovations };

FlowConfig Small(Form form) {
  FlowConfig config;
  config.flow_steps = 3;
  config.hidden = 16;
  config.condition_width = form == Form::kPaper ? 0 : 24;
  config.innovations = form == Form::kInnovations;
  return config;
}

// Continuous motion, [windows, 11, width].
Tensor Walks(int64_t windows, int64_t width) {
  return 0.1 * torch::randn({windows, 11, width}).cumsum(1).cumsum(1);
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

class FlowTest : public testing::TestWithParam<Form> {
 protected:
  void SetUp() override {
    torch::manual_seed(11);
    model_ = FlowModel(Small(GetParam()), Skeleton::Smpl24());
    Shake(*model_);
    const int64_t width = model_->feature_width();
    if (GetParam() == Form::kInnovations)
      model_->FitPrediction(Walks(300, width), torch::full({width}, 0.01));
    model_->eval();
  }
  // Raw: past frames, music and its flag, then the key's position, rotations and mask, and the time
  // embedding.
  int64_t ConditionWidth() const {
    const int64_t width = model_->feature_width();
    // Of innovations, what aims at the key, too.
    if (GetParam() == Form::kInnovations) return 24 + 3 + 3 * 24;
    return GetParam() == Form::kEncoded ? 24
                                        : 10 * width + (11 * 40 + 1) + (3 + 3 * 24 + 25) + width;
  }
  FlowModel model_{nullptr};
};

TEST_P(FlowTest, InverseUndoesForward) {
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

TEST_P(FlowTest, RolloutLikelihoodEqualsThatOfItsNoise) {
  torch::NoGradGuard no_grad;
  const int64_t frames = 5, width = model_->feature_width();
  const TransitionTensors transition = RandomTransition(3, frames);
  const Tensor condition = model_->StaticCondition(transition);
  const Tensor history = 0.2 * torch::randn({3, 10, width});
  const Tensor audio = torch::randn({3, 10 + frames, 40});
  const Tensor has_audio = torch::ones({3, 1});
  const Tensor noise = 0.5 * torch::randn({3, frames, width});
  const Tensor sampled = model_->Rollout(history, audio, has_audio, condition, noise);
  const Tensor likelihood =
      model_->LogLikelihood(torch::cat({history, sampled}, 1), audio, has_audio, condition);

  FlowState state = model_->flow()->InitialState(3);
  const auto step = model_->Step(history, audio.narrow(1, 0, 11), has_audio, condition.select(1, 0),
                                 noise.select(1, 0), model_->InverseWeights(), &state);
  EXPECT_TRUE(torch::allclose(step.log_likelihood, likelihood.select(1, 0), 1e-3, 1e-2));
  EXPECT_TRUE(torch::allclose(step.features, sampled.select(1, 0), 1e-5, 1e-5));
}

// Training has its own; serving and other devices have LibTorch's.
TEST(LstmLayerTest, ComputesAndLearnsAsTorchsOwn) {
  torch::manual_seed(4);
  torch::nn::LSTM reference(torch::nn::LSTMOptions(7, 12).batch_first(true));
  const std::vector<Tensor> weights = reference->parameters();
  const Tensor x = torch::randn({5, 9, 7}).set_requires_grad(true);
  const Tensor h = torch::randn({5, 12}).set_requires_grad(true);
  const Tensor c = torch::randn({5, 12}).set_requires_grad(true);
  std::vector<Tensor> inputs = {x, h, c};
  inputs.insert(inputs.end(), weights.begin(), weights.end());
  const Tensor to = torch::randn({5, 9, 12}), to_cell = torch::randn({5, 12});
  const auto learn = [&](const Tensor& out, const Tensor& last, const Tensor& cell) {
    return torch::autograd::grad({(out * to).sum() + (last * to_cell).sum() + cell.square().sum()},
                                 inputs);
  };
  LstmState state{h, c};
  const Tensor out = RunLstmLayer(x, {weights[0], weights[1], weights[2], weights[3]}, &state);
  const auto ours = learn(out, state.h, state.c);
  const auto [expected, next] =
      reference->forward(x, std::make_tuple(h.unsqueeze(0), c.unsqueeze(0)));
  const auto theirs = learn(expected, std::get<0>(next)[0], std::get<1>(next)[0]);
  EXPECT_TRUE(torch::allclose(out, expected, 1e-5, 1e-5));
  EXPECT_TRUE(torch::allclose(state.c, std::get<1>(next)[0], 1e-5, 1e-5));
  for (size_t i = 0; i < inputs.size(); ++i)
    EXPECT_TRUE(torch::allclose(ours[i], theirs[i], 1e-4, 1e-4)) << i;
}

TEST_P(FlowTest, TrainingAndServingSampleTheSameFrames) {
  const int64_t frames = 5, width = model_->feature_width();
  const Tensor condition = model_->StaticCondition(RandomTransition(2, frames));
  const Tensor history = 0.2 * torch::randn({2, 10, width});
  const Tensor audio = torch::randn({2, 10 + frames, 40}), heard = torch::ones({2, 1});
  const Tensor noise = torch::randn({2, frames, width});
  const Tensor learnt = model_->Rollout(history, audio, heard, condition, noise).detach();
  torch::NoGradGuard no_grad;
  EXPECT_TRUE(torch::allclose(learnt, model_->Rollout(history, audio, heard, condition, noise),
                              1e-4, 1e-4));
}

// Of the frame that is returned: outliers are bent, which makes them likelier.
TEST_P(FlowTest, LikelihoodOfALimitedFrameIsItsOwn) {
  model_->to(torch::kFloat64);
  const int64_t width = model_->feature_width();
  const auto wide = torch::TensorOptions(torch::kFloat64);
  const Tensor history = 0.2 * torch::randn({1, 10, width}, wide);
  const Tensor audio = torch::randn({1, 11, 40}, wide);
  const Tensor condition = torch::zeros({1, model_->static_width()}, wide);
  const double size = GetParam() == Form::kInnovations ? 40 : 4;  // they are small
  const Tensor noise = (size * torch::randn({1, width}, wide)).set_requires_grad(true);
  FlowState state = model_->flow()->InitialState(1);
  const auto step = model_->Step(history, audio, torch::ones({1, 1}, wide), condition, noise,
                                 model_->InverseWeights(), &state);
  ASSERT_GT(step.features.abs().max().item<double>(), kSampleBound);
  std::vector<Tensor> rows;
  for (int64_t i = 0; i < width; ++i)
    rows.push_back(torch::autograd::grad({step.features[0][i]}, {noise}, {}, true)[0].flatten());
  const double stretched = std::get<1>(torch::linalg_slogdet(torch::stack(rows))).item<double>();
  const double base =
      -0.5 * (noise.square().sum().item<double>() + width * std::log(2 * std::numbers::pi));
  EXPECT_NEAR(step.log_likelihood.item<double>(), base - stretched, 1e-6 * std::abs(base));
}

TEST_P(FlowTest, MusicKeyAndTimeLeftChangeTheDance) {
  torch::NoGradGuard no_grad;
  const int64_t frames = 4, width = model_->feature_width();
  const TransitionTensors transition = RandomTransition(1, frames);
  const Tensor history = 0.2 * torch::randn({1, 10, width});
  const Tensor audio = torch::randn({1, 10 + frames, 40});
  const Tensor noise = torch::zeros({1, frames, width});
  const auto dance = [&](const TransitionTensors& of, const Tensor& music, double has_audio) {
    const Tensor condition = model_->StaticCondition(of);
    return model_->Rollout(history, music, torch::full({1, 1}, has_audio), condition, noise);
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

std::string NameOf(const testing::TestParamInfo<Form>& form) {
  constexpr const char* kNames[] = {"Paper", "Encoded", "Innovations"};
  return kNames[static_cast<int>(form.param)];
}
INSTANTIATE_TEST_SUITE_P(Forms, FlowTest,
                         testing::Values(Form::kPaper, Form::kEncoded, Form::kInnovations), NameOf);

// Steady motion is predicted: the flow draws almost nothing.
TEST(FlowInnovations, AreThePredictionsResiduals) {
  torch::NoGradGuard no_grad;
  torch::manual_seed(8);
  const FlowConfig config = Small(Form::kInnovations);
  FlowModel model(config, Skeleton::Smpl24());
  const int64_t width = model->feature_width(), windows = 400;
  const Tensor time = torch::arange(11, torch::kFloat32).view({1, 11, 1});
  const Tensor phase = 6.283 * torch::rand({windows, 1, width});
  const Tensor waves = torch::sin(0.3 * time + phase);
  model->SetFeatureNormalisation(torch::zeros({width}), torch::full({width}, 0.7));
  const Tensor floor = torch::full({width}, 0.002);
  model->FitPrediction(waves + 1e-4 * torch::randn_like(waves), floor);
  EXPECT_TRUE(torch::allclose(model->DrawnSpread(), floor));
  model->FitPrediction(torch::randn({windows, 11, width}), floor);  // nothing to predict
  EXPECT_GT(model->DrawnSpread().min().item<double>(), 0.8);
}

TEST(InterpolationTest, EndsOnTheKey) {
  torch::NoGradGuard no_grad;
  torch::manual_seed(5);
  const TransitionTensors transition = RandomTransition(2, 20);
  const TrajectoryTensors line = Interpolate(transition);
  EXPECT_TRUE(torch::allclose(line.position.select(1, 19), transition.target_position, 1e-5, 1e-5));
  EXPECT_TRUE(torch::allclose(line.rotation.select(1, 19), transition.target_rotation, 1e-4, 1e-4));
}

// Engines compute a frame's key condition without LibTorch.
TEST(KeyConditionTest, EqualsTheModulesInput) {
  torch::NoGradGuard no_grad;
  torch::manual_seed(6);
  const Skeleton& skeleton = Skeleton::Smpl24();
  const int joints = skeleton.joints(), frames = 7;
  for (const bool partial : {false, true}) {
    for (const bool forward : {false, true}) {
      FlowConfig config = Small(Form::kPaper);
      config.forward_embedding = forward;
      FlowModel model(config, skeleton);
      Pose key{{0.1, 0.9, 0.4}, 0.4 * Eigen::Matrix3Xd::Random(3, joints)};
      PoseMask mask;
      TransitionTensors transition = RandomTransition(1, frames);
      for (int j = 0; j < joints; ++j) {
        const Eigen::Matrix<float, 3, 3, Eigen::RowMajor> matrix =
            ExpMap(key.rotations.col(j)).cast<float>();
        transition.target_rotation[0][j] =
            torch::from_blob(const_cast<float*>(matrix.data()), {3, 3}).clone();
      }
      transition.target_position = torch::tensor({{0.1F, 0.9F, 0.4F}});
      if (partial) {
        mask.root_position = false;
        mask.joints.assign(static_cast<size_t>(joints), true);
        mask.joints[5] = false;
        transition.target_mask[0][5] = transition.target_mask[0][joints] = 0;
      }
      const Eigen::MatrixXf written =
          KeyConditions(config, joints, model->feature_width(), frames, &key, mask);
      ASSERT_EQ(written.rows(), model->key_width());
      const Tensor expected = model->StaticCondition(transition)[0].contiguous();
      const Eigen::Map<const Eigen::MatrixXf> theirs(expected.data_ptr<float>(), written.rows(),
                                                     frames);
      EXPECT_LT((written - theirs).cwiseAbs().maxCoeff(), 1e-5);
      transition.target_mask.zero_();
      EXPECT_EQ(model->StaticCondition(transition).abs().max().item<float>(), 0);
      EXPECT_TRUE(
          KeyConditions(config, joints, model->feature_width(), frames, nullptr, {}).isZero());
    }
  }
}

TEST(TimeEmbeddingTest, IsEquationNine) {
  const Tensor e = TimeEmbedding(torch::tensor({7.0}, torch::kFloat64), 82)[0];
  for (const int l : {0, 1, 20, 40}) {
    const double phase = 7.0 / std::pow(10000.0, 2.0 * l / 82);
    EXPECT_NEAR(e[2 * l].item<double>(), std::sin(phase), 1e-9);
    EXPECT_NEAR(e[2 * l + 1].item<double>(), std::cos(phase), 1e-9);
  }
}

TEST(FlowPresets, HaveTheirStatedSizes) {
  const auto parameters = [](const char* name) {
    FlowModel model(FlowConfig::Preset(name), Skeleton::Smpl24());
    int64_t count = 0;
    for (const auto& parameter : model->parameters()) count += parameter.numel();
    return count;
  };
  EXPECT_LE(parameters("ablation"), 500'000);
  EXPECT_NEAR(static_cast<double>(parameters("paper-f")), 5.8e6, 4e5);
  EXPECT_NEAR(static_cast<double>(parameters("paper")), 99e6, 4e6);
  EXPECT_THROW(FlowConfig::Preset("large"), Error);
}

}  // namespace choreo::flow_test
