#include "model/papers/networks/inbetweener.h"

#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <nlohmann/json.hpp>

#include "model/flow/network/torch_kinematics.h"
#include "model/papers/networks/flow_checkpoint.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace choreo::inbetweener_test {

using torch::Tensor;

constexpr int64_t kBatch = 3, kFrames = 12;

class InbetweenerTest : public testing::Test {
 protected:
  InbetweenerTest() {
    torch::manual_seed(4);
    FlowConfig config = FlowConfig::Preset(kInbetweenerPreset);
    config.hidden = 24;
    model_ = Inbetweener(config, Skeleton::Smpl24());
    torch::NoGradGuard no_grad;
    for (auto& parameter : model_->parameters())
      parameter.add_(0.05 * torch::randn_like(parameter));
    const int64_t width = model_->feature_width();
    model_->SetNormalisation(0.01 * torch::randn({width}), 0.1 + torch::rand({width}));
    model_->eval();
    history_ = 0.1 * torch::randn({kBatch, 10, width});
  }

  static TransitionTensors Transition() {
    torch::manual_seed(5);
    const int64_t joints = Skeleton::Smpl24().joints();
    return {kFrames,
            0.1 * torch::randn({kBatch, 10, 3}),
            ExpMapBatch(0.3 * torch::randn({kBatch, 10, joints, 3})),
            0.3 * torch::randn({kBatch, 3}),
            ExpMapBatch(0.3 * torch::randn({kBatch, joints, 3})),
            torch::ones({kBatch, joints + 1})};
  }
  Tensor Rollout(const TransitionTensors& transition) {
    return model_->Rollout(history_,
                           KeyConditionTensors(model_->config(), model_->skeleton(), transition));
  }

  Inbetweener model_{nullptr};
  Tensor history_;
};

double Apart(const Tensor& a, const Tensor& b) { return (a - b).abs().max().item<double>(); }

TEST_F(InbetweenerTest, FeedsBackItsOwnFrames) {
  torch::NoGradGuard no_grad;
  const Tensor conditions = KeyConditionTensors(model_->config(), model_->skeleton(), Transition());
  const Tensor made = model_->Rollout(history_, conditions);
  Tensor all = history_;
  LstmState state = model_->InitialState(kBatch);
  for (int64_t t = 0; t < kFrames; ++t) {
    const int64_t known = t == 0 ? 10 : 2;
    const Tensor next = model_->Step(all.narrow(1, all.size(1) - known, known),
                                     conditions.select(1, t), Tensor(), &state);
    all = torch::cat({all, next.unsqueeze(1)}, 1);
  }
  EXPECT_LT(Apart(made, all.narrow(1, 10, kFrames)), 1e-6);
  EXPECT_GT(Apart(made.select(1, 0), made.select(1, kFrames - 1)), 1e-3);
}

// Training's fused layer and LibTorch's own.
TEST_F(InbetweenerTest, TrainingEqualsInference) {
  Tensor danced;
  {
    torch::NoGradGuard no_grad;
    danced = Rollout(Transition());
  }
  EXPECT_LT(Apart(Rollout(Transition()).detach(), danced), 1e-5);
}

TEST_F(InbetweenerTest, ReceivesTheMaskedKeyAndItsDistance) {
  torch::NoGradGuard no_grad;
  const TransitionTensors whole = Transition();
  TransitionTensors other = whole;
  other.target_position = whole.target_position + 0.5;
  EXPECT_GT(Apart(Rollout(other), Rollout(whole)), 1e-4);
  other.target_mask = whole.target_mask.clone();
  other.target_mask.select(1, 24).zero_();
  TransitionTensors open = whole;
  open.target_mask = other.target_mask;
  EXPECT_EQ(Apart(Rollout(other), Rollout(open)), 0) << "the root is open";
  EXPECT_GT(Apart(Rollout(open), Rollout(whole)), 1e-4);

  TransitionTensors later = whole;
  later.frames = 2 * kFrames;
  EXPECT_GT(Apart(Rollout(later).narrow(1, 0, kFrames), Rollout(whole)), 1e-4);
}

TEST_F(InbetweenerTest, TheVeilHidesFarKeysInTrainingAlone) {
  torch::NoGradGuard no_grad;
  TransitionTensors far = Transition(), near = Transition();
  far.frames = 30;
  near.frames = 5;
  EXPECT_EQ(Apart(Rollout(far), Rollout(far)), 0);
  model_->train();
  EXPECT_GT(Apart(Rollout(far), Rollout(far)), 1e-4);
  EXPECT_EQ(Apart(Rollout(near), Rollout(near)), 0);
}

TEST_F(InbetweenerTest, RoundTripsThroughItsCheckpoint) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.safetensors";
  const std::string hash = SaveInbetweener(path, model_, {{"data", "none"}});
  const Safetensors content = ReadSafetensors(path);
  EXPECT_TRUE(HoldsInbetweener(content));
  InbetweenerCheckpoint loaded = ParseInbetweener(content, "a");
  EXPECT_EQ(loaded.hash, hash);
  EXPECT_EQ(nlohmann::json(loaded.model->config()), nlohmann::json(model_->config()));
  torch::NoGradGuard no_grad;
  const Tensor expected = Rollout(Transition());
  model_ = loaded.model;
  EXPECT_EQ(Apart(Rollout(Transition()), expected), 0);
  ExpectError(ErrorCode::kInvalidArgument, "format", [&] { ParseCheckpoint(content, "a"); });
}

}  // namespace choreo::inbetweener_test
