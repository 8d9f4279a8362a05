#include "model/flow/variety.h"

#include <gtest/gtest.h>
#include <torch/torch.h>

#include "model/flow/torch_kinematics.h"

namespace choreo {
namespace {

using torch::Tensor;

constexpr int64_t kJoints = 24, kWidth = 3 + 3 * kJoints, kBatch = 16;

TransitionTensors Transition(int64_t frames, double mask) {
  return {frames,
          0.1 * torch::randn({kBatch, 10, 3}),
          ExpMapBatch(0.3 * torch::randn({kBatch, 10, kJoints, 3})),
          0.3 * torch::randn({kBatch, 3}),
          ExpMapBatch(0.3 * torch::randn({kBatch, kJoints, 3})),
          mask * torch::ones({kBatch, kJoints + 1})};
}

TrajectoryTensors Still(int64_t frames) {
  return {torch::zeros({kBatch, frames, 3}),
          torch::eye(3).expand({kBatch, frames, kJoints, 3, 3}).contiguous()};
}

// Two pose directions, each a slow sine of its own size: what Fit has to find.
Tensor Swaying(int64_t frames, double half_waves) {
  const Tensor t = torch::arange(1, frames + 1) / static_cast<double>(frames);
  const Tensor sine = (M_PI * half_waves * t).sin().view({1, frames, 1});
  Tensor directions = torch::zeros({2, kWidth});
  directions[0][5] = directions[0][8] = 0.2;
  directions[1][0] = 0.1;
  return sine * torch::matmul(torch::randn({kBatch, 1, 2}), directions);
}

class VarietyTest : public testing::Test {
 protected:
  void SetUp() override {
    torch::manual_seed(3);
    std::vector<VarietyImpl::Sample> samples;
    for (int i = 0; i < 24; ++i) {
      const int64_t frames = 20 + 10 * (i % 4);
      const bool keyed = i % 2 == 0;
      samples.push_back({Transition(frames, keyed ? 1 : 0), Swaying(frames, keyed ? 1 : 0.5)});
    }
    variety_->Fit(samples);
  }
  Variety variety_{static_cast<int>(kJoints), 2};
};

TEST_F(VarietyTest, SamplesHaveTheDirectionsAndSizesThatItSaw) {
  const TransitionTensors transition = Transition(40, 1);
  const Tensor normal = torch::randn({kBatch, VarietyImpl::Waves(40), 2});
  const Tensor difference =
      VarietyImpl::Difference(Still(40), variety_->Vary(transition, Still(40), normal));
  const Tensor middle = difference.select(1, 19);
  const Tensor spread = middle.square().mean(0).sqrt();
  EXPECT_NEAR(spread[5].item<double>(), 0.2, 0.1);
  EXPECT_NEAR(spread[0].item<double>(), 0.1, 0.05);
  EXPECT_TRUE(torch::allclose(middle.select(1, 5), middle.select(1, 8), 1e-2, 1e-3));
  EXPECT_LT(spread[40].item<double>(), 0.01);
}

TEST_F(VarietyTest, LeavesHistoryAndKeyAsTheyAre) {
  const Tensor normal = torch::randn({kBatch, VarietyImpl::Waves(40), 2});
  const auto of = [&](double mask) {
    return VarietyImpl::Difference(Still(40),
                                   variety_->Vary(Transition(40, mask), Still(40), normal));
  };
  const Tensor keyed = of(1), free = of(0);
  EXPECT_LT(keyed.select(1, 39).abs().max().item<double>(), 1e-5);
  EXPECT_GT(free.select(1, 39).abs().max().item<double>(), 0.02);
  for (const Tensor& one : {keyed, free})
    EXPECT_LT(one.select(1, 0).abs().max().item<double>(), 0.02);
}

TEST_F(VarietyTest, ApproachComesNearWhatItCanReach) {
  const TransitionTensors transition = Transition(40, 1);
  const Tensor sway = Swaying(40, 1);
  const TrajectoryTensors truth = {
      sway.narrow(2, 0, 3), ExpMapBatch(sway.narrow(2, 3, kWidth - 3).unflatten(2, {-1, 3}))};
  const Tensor left =
      VarietyImpl::Difference(variety_->Approach(transition, Still(40), truth), truth);
  EXPECT_LT(left.norm().item<double>(), 0.25 * sway.norm().item<double>());
}

TEST_F(VarietyTest, ShortTransitionsDoNotVary) {
  const TransitionTensors transition = Transition(4, 1);
  const TrajectoryTensors varied =
      variety_->Vary(transition, Still(4), torch::randn({kBatch, VarietyImpl::Waves(4), 2}));
  EXPECT_TRUE(torch::equal(varied.position, Still(4).position));
}

TEST(VarietyFitTest, WhatNoSampleShowsDoesNotVary) {
  torch::manual_seed(4);
  Variety variety(static_cast<int>(kJoints), 2);
  variety->Fit({{Transition(4, 1), Swaying(4, 1)}});  // too short for a wave
  const TrajectoryTensors varied = variety->Vary(Transition(40, 1), Still(40),
                                                 torch::randn({kBatch, VarietyImpl::Waves(40), 2}));
  EXPECT_LT(VarietyImpl::Difference(Still(40), varied).abs().max().item<double>(), 0.01);
}

}  // namespace
}  // namespace choreo
